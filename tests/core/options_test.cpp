#include "core/options.h"

#include <gtest/gtest.h>

#include "core/registry.h"

namespace plat {
namespace {

enum class Shade { kLight, kDark };

struct PaintOptions {
  double width_m = 2.5;
  int coats = 2;
  Shade shade = Shade::kDark;

  static constexpr auto fields() {
    return std::tuple{
        Field{"width_m", &PaintOptions::width_m, 0.5, 10.0, "how wide the brush is, m"},
        Field{"coats", &PaintOptions::coats, 1, 5, "how often"},
        EnumField<PaintOptions, Shade, 2>{"shade",
                                          &PaintOptions::shade,
                                          {{"light", Shade::kLight}, {"dark", Shade::kDark}},
                                          "how dark"}};
  }
};

struct RoofOptions {
  std::optional<double> height_m = std::nullopt;

  static constexpr auto fields() {
    return std::tuple{
        OptionalField{"height_m", &RoofOptions::height_m, 1, 9, "how high the roof is, m"}};
  }
};

PaintOptions read(const OptionMap& map) { return from_option_map<PaintOptions>("paint", map); }

/// The message of the InputError that `call` throws.
template <class Call>
std::string input_error(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Options, EmptyMapGivesTheDefaults) {
  const PaintOptions o = read({});
  EXPECT_EQ(o.width_m, 2.5);
  EXPECT_EQ(o.coats, 2);
  EXPECT_EQ(o.shade, Shade::kDark);
}

TEST(Options, ValuesAreReadByType) {
  const PaintOptions o = read({{"width_m", 3.0}, {"coats", 4.0}, {"shade", "light"}});
  EXPECT_EQ(o.width_m, 3.0);
  EXPECT_EQ(o.coats, 4);
  EXPECT_EQ(o.shade, Shade::kLight);
}

TEST(Options, AnAbsentNumberIsWrittenNone) {
  const auto roof = [](const OptionMap& map) { return from_option_map<RoofOptions>("roof", map); };
  EXPECT_EQ(roof({}).height_m, std::nullopt);
  EXPECT_EQ(roof({{"height_m", 3.5}}).height_m, 3.5);
  EXPECT_EQ(roof({{"height_m", "none"}}).height_m, std::nullopt);
  EXPECT_EQ(to_option_map(RoofOptions{}), (OptionMap{{"height_m", "none"}}));
  EXPECT_EQ(describe_fields<RoofOptions>().at(0).type, "number or none");
  EXPECT_NE(input_error([&] { roof({{"height_m", 10.0}}); }).find("1..9"), std::string::npos);
  EXPECT_NE(input_error([&] { roof({{"height_m", "high"}}); }).find("\"none\""), std::string::npos);
}

TEST(Options, WhatIsWrittenReadsBackTheSame) {
  const OptionMap map{{"width_m", 0.1 + 0.2 + 0.5}, {"coats", 5.0}, {"shade", "light"}};
  EXPECT_EQ(to_option_map(read(map)), map);
}

TEST(Options, UnknownKeyNamesTheOwnerAndTheNearestKey) {
  const std::string message = input_error([] { read({{"widht_m", 3.0}}); });
  EXPECT_NE(message.find("paint"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean \"width_m\"?"), std::string::npos) << message;
}

TEST(Options, FarFetchedKeyGetsNoSuggestionButTheList) {
  const std::string message = input_error([] { read({{"xyzzy", 3.0}}); });
  EXPECT_EQ(message.find("did you mean"), std::string::npos) << message;
  EXPECT_NE(message.find("coats"), std::string::npos) << message;
}

TEST(Options, RangeIsInclusive) {
  EXPECT_EQ(read({{"width_m", 0.5}}).width_m, 0.5);
  EXPECT_EQ(read({{"width_m", 10.0}}).width_m, 10.0);
  EXPECT_EQ(input_error([] { read({{"width_m", 10.5}}); }),
            "paint: width_m = 10.5, allowed 0.5..10");
  EXPECT_THROW(read({{"width_m", 0.4999}}), InputError);
}

TEST(Options, NotANumberAndInfinityAreOutOfRange) {
  EXPECT_THROW(read({{"width_m", std::nan("")}}), InputError);
  EXPECT_THROW(read({{"width_m", std::numeric_limits<double>::infinity()}}), InputError);
}

TEST(Options, WholeNumberMustBeWhole) {
  EXPECT_EQ(input_error([] { read({{"coats", 2.5}}); }), "paint: coats must be a whole number");
}

TEST(Options, NumberMustNotBeText) {
  EXPECT_EQ(input_error([] { read({{"width_m", "wide"}}); }), "paint: width_m must be a number");
}

TEST(Options, ChoiceMustNotBeANumber) { EXPECT_THROW(read({{"shade", 1.0}}), InputError); }

TEST(Options, UnknownChoiceListsTheAllowedOnes) {
  const std::string message = input_error([] { read({{"shade", "lihgt"}}); });
  EXPECT_NE(message.find("light, dark"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean \"light\"?"), std::string::npos) << message;
}

TEST(ParseOption, NumberWhereItReadsAsOneElseText) {
  EXPECT_EQ(parse_option("a=1.5"), (std::pair<std::string, OptionValue>{"a", 1.5}));
  EXPECT_EQ(parse_option("a=1.5m"), (std::pair<std::string, OptionValue>{"a", "1.5m"}));
  EXPECT_EQ(parse_option("a=b=c"), (std::pair<std::string, OptionValue>{"a", "b=c"}));
}

TEST(ParseOption, MissingKeyOrValueIsTheInputsFault) {
  for (const char* text : {"", "=", "a", "a=", "=1"})
    EXPECT_THROW(parse_option(text), InputError) << text;
}

TEST(OptionText, IsTheShortestThatReadsBackAndSortedByKey) {
  EXPECT_EQ(to_string(OptionValue{0.1}), "0.1");
  EXPECT_EQ(to_string(OptionMap{{"b", 2.0}, {"a", "x"}}), "a=x;b=2");
}

TEST(DescribeFields, TellsTypeDefaultRangeAndChoices) {
  const auto fields = describe_fields<PaintOptions>();
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(fields[0].type, "number");
  EXPECT_EQ(fields[0].max, 10.0);
  EXPECT_EQ(fields[1].type, "integer");
  EXPECT_EQ(fields[1].default_value, OptionValue{2.0});
  EXPECT_EQ(fields[2].type, "choice");
  EXPECT_EQ(fields[2].default_value, OptionValue{"dark"});
  EXPECT_EQ(fields[2].choices, (std::vector<std::string>{"light", "dark"}));
}

struct Brush {
  static constexpr std::string_view kName = "brush";
  static constexpr std::string_view kSummary = "paints slowly";
  using Options = PaintOptions;
  explicit Brush(const Options& o) : options(o) {}
  Options options;
};
struct Spray : Brush {
  static constexpr std::string_view kName = "spray";
  using Brush::Brush;
};
struct AnyPainter {
  explicit AnyPainter(const Brush& b) : coats(b.options.coats) {}
  int coats;
};

TEST(Registry, MakesByNameWithOptions) {
  Registry<AnyPainter> menu;
  menu.add<Spray>();
  menu.add<Brush>();
  EXPECT_EQ(menu.names(), (std::vector<std::string>{"brush", "spray"})) << "sorted";
  EXPECT_EQ(menu.make("brush").coats, 2);
  EXPECT_EQ(menu.make("spray", {{"coats", 3.0}}).coats, 3);
  EXPECT_EQ(menu.at("brush").summary, "paints slowly");
  EXPECT_EQ(menu.at("brush").fields.size(), 3U);
}

TEST(Registry, UnknownNameGetsASuggestionAndTheMenu) {
  Registry<AnyPainter> menu;
  menu.add<Brush>();
  const std::string message = input_error([&] { return menu.make("brsh"); });
  EXPECT_NE(message.find("did you mean \"brush\"?"), std::string::npos) << message;
}

TEST(Registry, UnknownOptionIsTheInputsFault) {
  Registry<AnyPainter> menu;
  menu.add<Brush>();
  EXPECT_THROW(static_cast<void>(menu.make("brush", {{"coat", 3.0}})), InputError);
}

TEST(Registry, SameNameTwiceIsOurFault) {
  Registry<AnyPainter> menu;
  menu.add<Brush>();
  EXPECT_THROW(menu.add<Brush>(), LogicError);
}

}  // namespace
}  // namespace plat
