#include "similarity/similarity_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>

#include "core/failure.h"
#include "core/sha256.h"
#include "geodata/scratch_folder.h"
#include "made_measures.h"
#include "made_shapes.h"
#include "made_tiles.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

namespace fs = std::filesystem;
using testing::clusters_of_rectangles;
using testing::made_measure;
using testing::random_rectangles;
using testing::rectangle;

/// What has changed in the code of a measure.
enum class CodeChange : std::uint8_t {
  kNone,
  kIsSymmetricUpToRounding,
  kCostsMore,
  kNearLotsCostMore,
  kFarLotsComeFirst,
  kAcceptsWhatHasNoArea,
  kFailsWithAnotherMessage,
};

/// MadeMeasure with its code changed: its name and options are the same.
class ChangedMeasure : public testing::MadeMeasure {
 public:
  explicit ChangedMeasure(const Options& options, CodeChange change = CodeChange::kNone)
      : MadeMeasure(options), change_(change) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const {
    auto prepared = MadeMeasure::prepare(shape);
    if (prepared) return prepared;
    if (change_ == CodeChange::kAcceptsWhatHasNoArea) return Prepared{};
    if (change_ == CodeChange::kFailsWithAnotherMessage) return fail(FailureCode::kTooSmall, "no");
    return prepared;
  }
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const {
    const double distance = MadeMeasure::distance(a, b);
    if (change_ == CodeChange::kIsSymmetricUpToRounding && a.area > b.area)
      return static_cast<double>(std::nextafter(static_cast<float>(distance), 1e9F));
    if (change_ == CodeChange::kCostsMore) return 1.5 * distance;
    if (change_ == CodeChange::kNearLotsCostMore)
      return distance < 20.0 ? 1.5 * distance : distance;
    if (change_ == CodeChange::kFarLotsComeFirst) return distance == 0.0 ? 0.0 : 1.0 / distance;
    return distance;
  }

 private:
  CodeChange change_;
};

AnyShapeSimilarity changed(CodeChange change) {
  return AnyShapeSimilarity(ChangedMeasure({}, change));
}

class SimilarityFile : public ::testing::Test {
 protected:
  void SetUp() override {
    Rng rng = ::plat::testing::property_rng("SimilarityFile");
    shapes_ = random_rectangles(8, rng);
    shapes_[4] = rectangle(0, 3);  // fails
    clusters_ = clusters_of_rectangles(shapes_, 3);
  }

  [[nodiscard]] MatrixInputs inputs(double asymmetry = 1.0) const {
    return {shapes_, clusters_, made_measure(asymmetry)};
  }
  [[nodiscard]] std::string read() const { return ::plat::testing::bytes_of(file()); }
  void write(const std::string& bytes) const { (void)folder_.write("m.sim", bytes); }
  [[nodiscard]] std::string file() const { return folder_.file("m.sim"); }
  /// What reading says; empty where it succeeds.
  [[nodiscard]] std::string refusal(const MatrixInputs& wanted) const {
    try {
      (void)read_similarity(file(), wanted);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  ::plat::testing::ScratchFolder folder_;
  std::vector<LabelledShape> shapes_;
  Clusters clusters_;
};

void expect_same(const SimilarityMatrix& a, const SimilarityMatrix& b) {
  EXPECT_EQ(a.layout, b.layout);
  EXPECT_EQ(a.keep, b.keep);
  EXPECT_EQ(a.cluster_of, b.cluster_of);
  EXPECT_EQ(a.members, b.members);
  EXPECT_EQ(a.rank, b.rank);
  EXPECT_EQ(a.first_entry, b.first_entry);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.entries, b.entries);
  ASSERT_EQ(a.failures.size(), b.failures.size());
  for (std::size_t i = 0; i < a.failures.size(); ++i) {
    EXPECT_EQ(a.failures[i].shape, b.failures[i].shape);
    EXPECT_EQ(a.failures[i].failure.code, b.failures[i].failure.code);
    EXPECT_EQ(a.failures[i].failure.message, b.failures[i].failure.message);
  }
}

/// The file with another number in it and the checksum that belongs to it.
std::string with_number(std::string bytes, std::size_t at, std::uint32_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof(number));
  Sha256 hash;
  hash.add(std::as_bytes(std::span(bytes)).first(bytes.size() - sizeof(Sha256Digest)));
  const Sha256Digest digest = hash.digest();
  std::memcpy(bytes.data() + bytes.size() - digest.size(), digest.data(), digest.size());
  return bytes;
}

TEST_F(SimilarityFile, ReadsBackWhatWasWrittenInEveryLayout) {
  for (int layout = 0; layout < 3; ++layout) {
    MatrixInputs wanted = inputs(layout == 1 ? 0.0 : 1.0);
    if (layout == 2) wanted.pruning = MatrixPruning{made_measure(), 2};
    const SimilarityMatrix matrix = compute_matrix(wanted);
    EXPECT_EQ(matrix.failures.size(), 1U);
    write_similarity(file(), matrix, wanted);
    expect_same(read_similarity(file(), wanted), matrix);
    EXPECT_FALSE(fs::exists(file() + ".part"));
  }
}

TEST_F(SimilarityFile, RefusesEveryTruncation) {
  MatrixInputs wanted = inputs();
  wanted.pruning = MatrixPruning{made_measure(), 2};
  write_similarity(file(), compute_matrix(wanted), wanted);
  const std::string whole = read();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(whole.substr(0, size));
    ASSERT_NE(refusal(wanted), "") << size << " of " << whole.size();
  }
  write(whole + 'x');
  EXPECT_NE(refusal(wanted), "");
  write(whole);
  EXPECT_EQ(refusal(wanted), "");
}

TEST_F(SimilarityFile, RefusesEveryChangedByte) {
  MatrixInputs wanted = inputs();
  wanted.pruning = MatrixPruning{made_measure(), 2};
  write_similarity(file(), compute_matrix(wanted), wanted);
  const std::string whole = read();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (at % 8)));
    write(changed);
    ASSERT_NE(refusal(wanted), "") << "byte " << at;
  }
}

TEST_F(SimilarityFile, RefusesAFileOfOtherInputs) {
  const MatrixInputs wanted = inputs();
  write_similarity(file(), compute_matrix(wanted), wanted);
  EXPECT_EQ(refusal(wanted), "");
  const auto expect_stale = [&](auto change) {
    auto shapes = shapes_;
    Clusters clusters = clusters_;
    change(shapes, clusters);
    EXPECT_NE(refusal({shapes, clusters, wanted.measure}).find("not those it was computed for"),
              std::string::npos);
  };
  expect_stale([](auto& shapes, auto&) {
    double& x = shapes[6].polygon.outer[1].x;
    x = std::nextafter(x, 1000.0);
  });
  expect_stale([](auto& shapes, auto&) { shapes[0].zone += "x"; });
  expect_stale([](auto& shapes, auto&) { shapes[0].edges.assign(4, EdgeLabel::kStreet); });
  expect_stale(
      [](auto& shapes, auto&) { shapes[0].polygon.holes.push_back({{1, 1}, {1, 2}, {2, 2}}); });
  expect_stale([](auto& shapes, auto& clusters) {
    shapes.pop_back();
    clusters.cluster_of.pop_back();
  });
  expect_stale([](auto&, auto& clusters) {
    std::swap(clusters.cluster_of[0],
              *std::find_if(clusters.cluster_of.begin(), clusters.cluster_of.end(),
                            [&](std::uint32_t k) { return k != clusters.cluster_of[0]; }));
  });
  MatrixInputs pruned = wanted;
  pruned.pruning = MatrixPruning{made_measure(), 3};
  EXPECT_NE(refusal(pruned).find("pruning"), std::string::npos);
  EXPECT_NE(refusal(inputs(2.0)).find("asymmetry"), std::string::npos);
}

TEST_F(SimilarityFile, RefusesOtherNumbersKeptPerRow) {
  MatrixInputs wanted = inputs();
  wanted.pruning = MatrixPruning{made_measure(), 2};
  write_similarity(file(), compute_matrix(wanted), wanted);
  wanted.pruning->keep = 3;
  EXPECT_NE(refusal(wanted).find("stale"), std::string::npos);
}

TEST_F(SimilarityFile, RefusesDistancesThatTheMeasureNoLongerGives) {
  const MatrixInputs wanted = inputs();
  SimilarityMatrix matrix = compute_matrix(wanted);
  for (float& entry : matrix.entries) entry *= 1.5F;  // as other code would have written it
  write_similarity(file(), matrix, wanted);
  EXPECT_NE(refusal(wanted).find("no longer gives"), std::string::npos);
}

TEST_F(SimilarityFile, ReadsBackEveryMeasureOfTheRegistryForMadeLots) {
  Rng rng = ::plat::testing::property_rng("SimilarityFileRegistry");
  for (int round = 0; round < ::plat::testing::iterations(6); ++round) {
    shapes_ = ::plat::testing::made_tiles(rng, 5, 4);
    for (int i = 0; i < 10; ++i) shapes_.push_back(::plat::testing::made_shape(rng));
    clusters_ = Clusters{std::vector<std::uint32_t>(shapes_.size()), {{}, {}}};
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
      const auto cluster = static_cast<std::uint32_t>(rng.index(2));
      clusters_.cluster_of[i] = cluster;
      clusters_.members[cluster].push_back(i);
    }
    for (const std::string& name : shape_similarities().names()) {
      for (const bool is_pruned : {false, true}) {
        MatrixInputs wanted{shapes_, clusters_, shape_similarities().make(name)};
        if (is_pruned) wanted.pruning = MatrixPruning{shape_similarities().make("box"), 4};
        const SimilarityMatrix matrix = compute_matrix(wanted);
        write_similarity(file(), matrix, wanted);
        ASSERT_EQ(refusal(wanted), "") << name << ", round " << round;
        expect_same(read_similarity(file(), wanted), matrix);
      }
    }
  }
}

TEST_F(SimilarityFile, ReadsBackAMeasureThatIsSymmetricUpToRounding) {
  const MatrixInputs wanted{shapes_, clusters_, changed(CodeChange::kIsSymmetricUpToRounding)};
  const SimilarityMatrix matrix = compute_matrix(wanted);
  ASSERT_EQ(matrix.layout, MatrixLayout::kTriangles);
  write_similarity(file(), matrix, wanted);
  EXPECT_EQ(refusal(wanted), "");
}

TEST_F(SimilarityFile, FindsChangedCodeThatDoesNotShowInTheNearest) {
  shapes_ = {rectangle(10, 10), rectangle(10, 10), rectangle(20, 10), rectangle(20, 10)};
  clusters_ = {{0, 0, 0, 0}, {{0, 1, 2, 3}}};
  const MatrixInputs wanted = inputs(0.0);
  write_similarity(file(), compute_matrix(wanted), wanted);
  EXPECT_EQ(refusal({shapes_, clusters_, changed(CodeChange::kNone)}), "");
  EXPECT_NE(refusal({shapes_, clusters_, changed(CodeChange::kCostsMore)}).find("no longer gives"),
            std::string::npos);
}

TEST_F(SimilarityFile, FindsChangedCodeThatShowsInTheNearestOnly) {
  shapes_ = {rectangle(10, 10), rectangle(10, 11), rectangle(30, 30)};
  clusters_ = {{0, 0, 0}, {{0, 1, 2}}};
  const MatrixInputs wanted = inputs(0.0);
  write_similarity(file(), compute_matrix(wanted), wanted);
  EXPECT_NE(
      refusal({shapes_, clusters_, changed(CodeChange::kNearLotsCostMore)}).find("no longer gives"),
      std::string::npos);
}

TEST_F(SimilarityFile, FindsChangedCodeWhereMostRowsHaveNoEntries) {
  constexpr std::uint32_t kShapes = 330;
  constexpr std::uint32_t kPair = 7;  // 7 and 8 are together, every other shape is alone
  shapes_.clear();
  clusters_ = {};
  for (std::uint32_t i = 0; i < kShapes; ++i) {
    shapes_.push_back(rectangle(10, 10 + i));
    if (i == kPair + 1) {
      clusters_.cluster_of.push_back(kPair);
      clusters_.members[kPair].push_back(i);
    } else {
      clusters_.cluster_of.push_back(static_cast<std::uint32_t>(clusters_.members.size()));
      clusters_.members.push_back({i});
    }
  }
  const MatrixInputs wanted = inputs(0.0);
  write_similarity(file(), compute_matrix(wanted), wanted);
  EXPECT_NE(refusal({shapes_, clusters_, changed(CodeChange::kCostsMore)}).find("no longer gives"),
            std::string::npos);
}

TEST_F(SimilarityFile, FindsChangedCodeOfTheCheapMeasure) {
  MatrixInputs wanted = inputs();
  clusters_ = clusters_of_rectangles(shapes_, 1);
  wanted.pruning = MatrixPruning{changed(CodeChange::kNone), 2};
  write_similarity(file(), compute_matrix(wanted), wanted);
  EXPECT_EQ(refusal(wanted), "");
  wanted.pruning->cheap = changed(CodeChange::kFarLotsComeFirst);
  EXPECT_NE(refusal(wanted).find("no longer chooses"), std::string::npos);
}

TEST_F(SimilarityFile, FindsChangedFailures) {
  const MatrixInputs wanted = inputs(0.0);
  write_similarity(file(), compute_matrix(wanted), wanted);
  for (const CodeChange change :
       {CodeChange::kAcceptsWhatHasNoArea, CodeChange::kFailsWithAnotherMessage})
    EXPECT_NE(refusal({shapes_, clusters_, changed(change)}).find("failures"), std::string::npos);
}

TEST_F(SimilarityFile, RefusesUnknownLayouts) {
  const MatrixInputs wanted = inputs(0.0);
  write_similarity(file(), compute_matrix(wanted), wanted);
  const std::string whole = read();
  constexpr std::size_t kLayoutAt = 8 + 4 + 4 + 32;  // behind magic, version, byte order, digest
  for (const std::uint32_t layout : {0U, 4U, 256U + 2U, 0x01000002U}) {
    write(with_number(whole, kLayoutAt, layout));
    EXPECT_NE(refusal(wanted).find("layout"), std::string::npos) << layout;
  }
  write(with_number(whole, kLayoutAt, 2));
  EXPECT_EQ(refusal(wanted), "") << "kTriangles, as it was";
}

TEST_F(SimilarityFile, SaysWhatIsWrong) {
  const MatrixInputs wanted = inputs();
  EXPECT_NE(refusal(wanted).find("cannot be read"), std::string::npos);
  write("GPKG, and something else");
  EXPECT_NE(refusal(wanted).find("is no similarity matrix"), std::string::npos);
  write_similarity(file(), compute_matrix(wanted), wanted);
  std::string bytes = read();
  bytes[8] = 9;
  write(bytes);
  EXPECT_NE(refusal(wanted).find("format version 9, this program reads 1"), std::string::npos);
  bytes[8] = 1;
  std::reverse(bytes.begin() + 12, bytes.begin() + 16);
  write(bytes);
  EXPECT_NE(refusal(wanted).find("byte order"), std::string::npos);
}

TEST_F(SimilarityFile, IsComputedOnceAndAgainWhenStaleOrDamaged) {
  MatrixInputs wanted = inputs();
  const auto first = load_or_compute_similarity(file(), wanted);
  EXPECT_NE(first.why_computed.find("was not there"), std::string::npos);
  const auto second = load_or_compute_similarity(file(), wanted);
  EXPECT_EQ(second.why_computed, "");
  expect_same(first.matrix, second.matrix);
  shapes_[0] = rectangle(7, 8);
  const auto third = load_or_compute_similarity(file(), wanted);
  EXPECT_NE(third.why_computed.find("stale"), std::string::npos);
  expect_same(third.matrix, compute_matrix(wanted));
  write(read().substr(0, 100));
  EXPECT_NE(load_or_compute_similarity(file(), wanted).why_computed.find("damaged"),
            std::string::npos);
  EXPECT_EQ(refusal(wanted), "");
}

TEST_F(SimilarityFile, NeverOverwritesAnotherKindOfFile) {
  write("my city");
  EXPECT_THROW((void)load_or_compute_similarity(file(), inputs()), InputError);
  EXPECT_EQ(read(), "my city");
  EXPECT_THROW((void)load_or_compute_similarity(folder_.file("none/m.sim"), inputs()), InputError);
}

}  // namespace
}  // namespace plat::similarity
