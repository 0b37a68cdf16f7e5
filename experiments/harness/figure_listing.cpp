#include "harness/figure_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/failure.h"
#include "core/options.h"

namespace plat::harness {
namespace {

using nlohmann::json;

PaperFigure figure_from(const json& object, const std::filesystem::path& folder) {
  PaperFigure out;
  out.id = object.at("id");
  out.title = object.at("title");
  out.script = folder / object.at("script").get<std::string>();
  out.datasets = object.at("datasets").get<std::vector<std::string>>();
  out.run_time_s = object.at("run_time_s");
  out.claim_count = object.at("claims").size();
  return out;
}

std::string_view paper_of(std::string_view id) { return id.substr(0, id.find('/')); }

}  // namespace

std::filesystem::path figures_folder() {
  const char* folder = std::getenv("PLAT_FIGURES_DIR");
  return folder != nullptr ? folder : PLAT_SOURCE_FIGURES_DIR;
}

std::vector<PaperFigure> read_figures(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "figures.json";
  std::ifstream in(file);
  if (!in)
    throw InputError(file.string() +
                     ": missing; set PLAT_FIGURES_DIR to Plat's paper_figures folder");
  try {
    std::vector<PaperFigure> out;
    const json listing = json::parse(in);
    for (const json& object : listing.at("figures")) out.push_back(figure_from(object, folder));
    return out;
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::vector<PaperFigure> choose_figures(const std::vector<PaperFigure>& all,
                                        const std::vector<std::string>& names) {
  std::vector<bool> is_chosen(all.size(), false);
  for (const std::string& name : names) {
    bool is_known = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].id != name && paper_of(all[i].id) != name) continue;
      is_chosen[i] = is_known = true;
    }
    if (is_known) continue;
    std::vector<std::string_view> known;
    for (const PaperFigure& figure : all) known.emplace_back(figure.id);
    throw InputError(fmt::format("no figure \"{}\"{}; `plat figure --list` names them all", name,
                                 did_you_mean(name, known)));
  }
  std::vector<PaperFigure> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_chosen[i]) out.push_back(all[i]);
  }
  return out;
}

}  // namespace plat::harness
