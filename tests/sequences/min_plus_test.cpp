#include "sequences/min_plus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/failure.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::property_rng;

constexpr std::array<InstructionSet, 3> kSets{InstructionSet::kScalar, InstructionSet::kAvx2,
                                              InstructionSet::kAvx512};
constexpr std::array<std::size_t, 6> kLayers{1, 4, 8, 15, 16, 40};

/// Mostly small costs, some that are not there, some at the ends of the range.
template <class Value>
std::vector<Value> random_costs(Rng& rng, std::size_t count) {
  std::vector<Value> costs(count);
  for (Value& cost : costs) {
    const std::size_t kind = rng.index(8);
    cost = kind == 0   ? kInfinite<Value>
           : kind == 1 ? kInfinite<Value> - 1
           : kind == 2 ? Value{0}
                       : static_cast<Value>(rng.index(1000));
  }
  return costs;
}

/// Every supported set with every width.
template <class Value, class Check>
void for_all_kernels(Check check) {
  for (const InstructionSet set : kSets) {
    if (!is_supported(set)) continue;
    for (const std::size_t layers : kLayers) {
      SCOPED_TRACE(std::string(instruction_set_name(set)) + ", layers " + std::to_string(layers));
      check(min_plus_kernels<Value>(set, layers));
    }
  }
}

template <class Value>
struct MinPlus : ::testing::Test {};
using Values = ::testing::Types<std::int32_t, std::int64_t>;
TYPED_TEST_SUITE(MinPlus, Values);

TYPED_TEST(MinPlus, ProductAgreesWithANaiveLoopOnAllSets) {
  using Value = TypeParam;
  for_all_kernels<Value>([](const MinPlusKernels<Value>& kernels) {
    Rng rng = property_rng("min_plus.product");
    for (std::size_t tails = 1; tails < 14; ++tails) {
      const std::size_t heads = 1 + rng.index(20);
      const std::size_t panels = (tails + kPanelTails - 1) / kPanelTails;
      const auto costs = random_costs<Value>(rng, panels * kPanelTails * heads);
      const std::size_t stride = kernels.width + 3;
      const auto values = random_costs<Value>(rng, heads * stride);
      auto out = random_costs<Value>(rng, tails * stride);
      std::vector<const Value*> sources;
      for (std::size_t h = 0; h < heads; ++h) sources.push_back(values.data() + h * stride + 1);
      auto expected = out;
      for (std::size_t t = 0; t < tails; ++t)
        for (std::size_t h = 0; h < heads; ++h)
          for (std::size_t l = 0; l < kernels.width; ++l) {
            const Value cost = costs[(t / kPanelTails * heads + h) * kPanelTails + t % kPanelTails];
            Value& least = expected[t * stride + l];
            least = std::min<Value>(least, cost + sources[h][l]);
          }
      kernels.product(costs.data(), sources.data(), heads, out.data(), stride, tails);
      ASSERT_EQ(out, expected) << tails << " tails, " << heads << " heads";
    }
  });
}

TYPED_TEST(MinPlus, GatherAgreesWithANaiveLoopOnAllSets) {
  using Value = TypeParam;
  for_all_kernels<Value>([](const MinPlusKernels<Value>& kernels) {
    Rng rng = property_rng("min_plus.gather");
    for (std::size_t arcs = 0; arcs < 12; ++arcs) {
      const auto costs = random_costs<Value>(rng, arcs);
      const auto values = random_costs<Value>(rng, 100);
      auto out = random_costs<Value>(rng, kernels.width);
      std::vector<const Value*> sources;
      for (std::size_t s = 0; s < 5; ++s) sources.push_back(values.data() + 7 * s);
      std::vector<std::uint32_t> source_of;
      for (std::size_t a = 0; a < arcs; ++a)
        source_of.push_back(static_cast<std::uint32_t>(rng.index(5)));
      auto expected = out;
      for (std::size_t a = 0; a < arcs; ++a)
        for (std::size_t l = 0; l < kernels.width; ++l)
          expected[l] = std::min<Value>(expected[l], costs[a] + sources[source_of[a]][l]);
      kernels.gather(costs.data(), source_of.data(), sources.data(), arcs, out.data());
      ASSERT_EQ(out, expected) << arcs << " arcs";
    }
  });
}

TYPED_TEST(MinPlus, RowAgreesWithANaiveLoopOnAllSets) {
  using Value = TypeParam;
  for_all_kernels<Value>([](const MinPlusKernels<Value>& kernels) {
    Rng rng = property_rng("min_plus.row");
    for (std::size_t stride = kRowMultiple; stride <= 9 * kRowMultiple; stride += kRowMultiple) {
      const auto columns = random_costs<Value>(rng, 9 * stride);
      const std::size_t count = rng.index(8);
      const auto addends = random_costs<Value>(rng, count);
      std::vector<std::uint32_t> heads;
      for (std::size_t k = 0; k < count; ++k)
        heads.push_back(static_cast<std::uint32_t>(rng.index(9)));
      auto out = random_costs<Value>(rng, stride);
      auto expected = out;
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t t = 0; t < stride; ++t)
          expected[t] = std::min<Value>(expected[t], columns[heads[k] * stride + t] + addends[k]);
      kernels.row(columns.data(), stride, heads.data(), addends.data(), count, out.data());
      ASSERT_EQ(out, expected) << stride;
    }
  });
}

TYPED_TEST(MinPlus, InfinityAddedToInfinityStaysInfinite) {
  using Value = TypeParam;
  for_all_kernels<Value>([](const MinPlusKernels<Value>& kernels) {
    const std::vector<Value> infinite(kPanelTails * kMaxWidth, kInfinite<Value>);
    std::vector<Value> out = infinite;
    const Value* source = infinite.data();
    kernels.product(infinite.data(), &source, 1, out.data(), kMaxWidth, kPanelTails);
    EXPECT_EQ(out, infinite);
  });
}

TEST(InstructionSet, ResolvesToWhatTheProcessorHas) {
  EXPECT_EQ(resolved(InstructionSet::kScalar), InstructionSet::kScalar);
  EXPECT_NE(resolved(InstructionSet::kAuto), InstructionSet::kAuto);
  for (const InstructionSet set : kSets) {
    if (is_supported(set))
      EXPECT_EQ(resolved(set), set);
    else
      EXPECT_THROW(resolved(set), InputError);
  }
}

}  // namespace
}  // namespace plat::sequences
