#include <fmt/format.h>

#include <utility>

#include "harness/city_layers.h"
#include "harness/observed_exemplar.h"
#include "streets/intersection_point_layer.h"

namespace plat::harness {
namespace {

using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;
using streets::StreetChain;

Layer points_layer(const ObservedExemplar& observed) {
  const streets::Exemplar& exemplar = observed.exemplar;
  Layer layer = streets::intersection_point_layer(exemplar.points, observed.frame);
  layer.fields.push_back({"a_chain", FieldType::kInteger});
  layer.fields.push_back({"b_chain", FieldType::kInteger});
  for (std::size_t i = 0; i < layer.features.size(); ++i) {
    auto& attributes = layer.features[i].attributes;
    attributes.resize(layer.fields.size());
    const streets::Exemplar::Chains& chains = exemplar.chains_of_point[i];
    attributes[attributes.size() - 2] = std::int64_t{chains.a};
    if (chains.b) attributes.back() = std::int64_t{*chains.b};
  }
  return layer;
}

Layer pieces_layer(const ObservedExemplar& observed) {
  Layer layer = street_layer(observed.network, observed.frame);
  layer.fields.push_back({"chain", FieldType::kInteger});
  layer.fields.push_back({"hierarchy", FieldType::kInteger});
  for (Feature& feature : layer.features) feature.attributes.resize(layer.fields.size());
  const auto& chains = observed.exemplar.chains;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    for (const StreetChain::Piece& piece : chains[c].pieces) {
      auto& attributes = layer.features[piece.street].attributes;
      attributes[attributes.size() - 2] = static_cast<std::int64_t>(c);
      attributes.back() = std::int64_t{chains[c].hierarchy};
    }
  }
  return layer;
}

Layer chains_layer(const ObservedExemplar& observed) {
  Layer layer{"chains",
              GeometryKind::kLine,
              observed.frame,
              {{"chain", FieldType::kInteger},
               {"name", FieldType::kText},
               {"hierarchy", FieldType::kInteger},
               {"pieces", FieldType::kInteger},
               {"is_closed", FieldType::kInteger},
               {"length_m", FieldType::kReal},
               {"tortuosity", FieldType::kReal},
               {"distance_mean_m", FieldType::kReal},
               {"distance_variance_m2", FieldType::kReal},
               {"angle_mean_rad", FieldType::kReal},
               {"angle_variance_rad2", FieldType::kReal},
               {"width_m", FieldType::kReal}},
              {}};
  const streets::Exemplar& exemplar = observed.exemplar;
  for (std::size_t c = 0; c < exemplar.chains.size(); ++c) {
    const StreetChain& chain = exemplar.chains[c];
    const streets::PassingStreet& style = exemplar.styles[c];
    Feature feature;
    feature.id = fmt::format("{}", c);
    feature.lines.push_back(streets::line_of(observed.network, chain));
    feature.attributes = {static_cast<std::int64_t>(c),
                          observed.network.streets[chain.pieces.front().street].attributes.name,
                          std::int64_t{chain.hierarchy},
                          static_cast<std::int64_t>(chain.pieces.size()),
                          std::int64_t{chain.is_closed ? 1 : 0},
                          streets::length_m(observed.network, chain),
                          style.tortuosity,
                          style.distance_mean_m,
                          style.distance_variance_m2,
                          style.angle_mean_rad,
                          style.angle_variance_rad2,
                          style.width_m};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

}  // namespace

std::vector<Layer> exemplar_layers(const ObservedExemplar& observed) {
  return {points_layer(observed), pieces_layer(observed), chains_layer(observed)};
}

}  // namespace plat::harness
