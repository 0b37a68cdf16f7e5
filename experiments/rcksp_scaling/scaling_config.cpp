#include "rcksp_scaling/scaling_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/config_reader_internal.h"

namespace plat::rcksp {
namespace {

using harness::ObjectReader;
using nlohmann::json;
using Menu = Registry<sequences::AnySequenceSearch>;

constexpr int kMostRounds = 1000;
constexpr int kMostResamples = 100000;

const json& list_at(ObjectReader& reader, std::string_view key, const std::string& where) {
  const json* list = reader.find(key);
  if (list == nullptr || !list->is_array() || list->empty())
    throw InputError(fmt::format("{}: \"{}\" must be a list that is not empty", where, key));
  return *list;
}

std::vector<double> numbers_at(ObjectReader& reader, std::string_view key,
                               const std::string& where) {
  std::vector<double> out;
  for (const json& number : list_at(reader, key, where)) {
    if (!number.is_number())
      throw InputError(fmt::format("{}: \"{}\" must be a list of numbers", where, key));
    out.push_back(number.get<double>());
  }
  return out;
}

double number_at(ObjectReader& reader, std::string_view key, double fallback, double min,
                 double max, const std::string& where) {
  const json* value = reader.find(key);
  if (value == nullptr) return fallback;
  if (!value->is_number()) throw InputError(fmt::format("{}: \"{}\" must be a number", where, key));
  const auto number = value->get<double>();
  if (!(number >= min && number <= max))
    throw InputError(fmt::format("{}: {} = {}, allowed {}..{}", where, key, number, min, max));
  return number;
}

std::string name_at(ObjectReader& reader, std::string_view key, const std::string& where) {
  std::string name = reader.text(key, "");
  if (name.empty()) throw InputError(fmt::format("{}: \"{}\" is missing", where, key));
  return name;
}

StrategyChoice read_strategy(const json& object, const std::string& where) {
  ObjectReader reader(object, where);
  StrategyChoice out;
  out.name = name_at(reader, "name", where);
  out.label = reader.text("label", out.name);
  if (const json* options = reader.find("options"))
    out.options = harness::read_options(*options, where);
  reader.expect_nothing_else();
  return out;
}

std::vector<StrategyChoice> read_strategies(ObjectReader& reader, const Menu& menu,
                                            const std::string& source) {
  std::vector<StrategyChoice> out;
  const json* list = reader.find("strategies");
  if (list == nullptr || *list == "all") {
    for (const std::string& name : menu.names()) out.push_back({name, name, {}});
    return out;
  }
  const std::string where = source + ": strategies";
  if (!list->is_array() || list->empty())
    throw InputError(where + ": must be \"all\" or a list of objects");
  std::set<std::string> labels;
  for (const json& object : *list) {
    out.push_back(read_strategy(object, where));
    harness::naming(where,
                    [&] { static_cast<void>(menu.make(out.back().name, out.back().options)); });
    if (!labels.insert(out.back().label).second)
      throw InputError(fmt::format("{}: label \"{}\" comes twice", where, out.back().label));
  }
  return out;
}

Study read_study(const json& object, const std::string& source) {
  ObjectReader reader(object, source + ": studies");
  Study out;
  out.name = name_at(reader, "name", source + ": studies");
  const std::string where = fmt::format("{}: study {}", source, out.name);
  out.title = reader.text("title", out.name);
  out.vary = name_at(reader, "vary", where);
  out.values = numbers_at(reader, "values", where);
  if (const json* options = reader.find("set")) out.set = harness::read_options(*options, where);
  if (out.set.contains(out.vary))
    throw InputError(fmt::format("{}: \"{}\" cannot be set and varied", where, out.vary));
  const std::string unfinished = reader.text("on_unfinished", "skip_rest");
  if (unfinished != "skip_rest" && unfinished != "try_all")
    throw InputError(
        fmt::format("{}: \"on_unfinished\" must be \"skip_rest\" or \"try_all\"", where));
  out.is_easiest_first = unfinished == "skip_rest";
  reader.expect_nothing_else();
  harness::naming(where, [&] {
    for (const double value : out.values) static_cast<void>(out.cell(value));
  });
  return out;
}

PublishedCurve read_published(const json& object, const std::string& source) {
  const std::string where = source + ": published";
  ObjectReader reader(object, where);
  PublishedCurve out;
  out.label = name_at(reader, "label", where);
  out.study = name_at(reader, "study", where);
  out.quantity = name_at(reader, "quantity", where);
  out.values = numbers_at(reader, "values", where);
  out.numbers = numbers_at(reader, "numbers", where);
  if (out.values.size() != out.numbers.size())
    throw InputError(where + ": \"values\" and \"numbers\" must be of one length");
  reader.expect_nothing_else();
  return out;
}

void read_limits(ObjectReader& reader, ScalingConfig& out, const std::string& source) {
  out.rounds = static_cast<int>(reader.whole("rounds", out.rounds, 1, kMostRounds));
  out.resamples = static_cast<int>(reader.whole("resamples", out.resamples, 1, kMostResamples));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1LL << 53));
  out.cell_budget_s = number_at(reader, "cell_budget_s", out.cell_budget_s, 0.0, 1e5, source);
  out.limits.time_s = number_at(reader, "time_limit_s", out.limits.time_s, 0.01, 1e5, source);
  out.limits.memory_mb =
      number_at(reader, "memory_limit_mb", out.limits.memory_mb, 100.0, 1e9, source);
}

}  // namespace

CellOptions Study::cell(double value) const {
  OptionMap options = set;
  options.insert_or_assign(vary, value);
  return from_option_map<CellOptions>(name, options);
}

ScalingConfig parse_scaling_config(const json& object, const std::string& source,
                                   const Menu& menu) {
  ObjectReader reader(object, source);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  ScalingConfig out;
  out.strategies = read_strategies(reader, menu, source);
  for (const json& study : list_at(reader, "studies", source))
    out.studies.push_back(read_study(study, source));
  if (const json* published = reader.find("published"))
    for (const json& curve : *published) out.published.push_back(read_published(curve, source));
  out.reference = reader.text("reference", "");
  const auto is_reference = [&](const StrategyChoice& s) { return s.label == out.reference; };
  if (!out.reference.empty() && std::ranges::none_of(out.strategies, is_reference))
    throw InputError(
        fmt::format("{}: reference \"{}\" is no label of a strategy", source, out.reference));
  read_limits(reader, out, source);
  reader.expect_nothing_else();
  return out;
}

}  // namespace plat::rcksp
