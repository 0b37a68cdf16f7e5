#include "similarity/similarity_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.h"
#include "core/failure.h"
#include "core/options.h"
#include "core/sha256.h"
#include "similarity/matrix_rows_internal.h"
#include "similarity/packed_bytes_internal.h"

namespace plat::similarity {
namespace {

using detail::Bytes;
using detail::Packer;
using detail::PreparedInputs;
using detail::Unpacker;

constexpr std::string_view kMagic = "platsim\n";
constexpr std::uint32_t kByteOrder = 0x01020304;
/// Rows of which something is computed again when a file is read.
constexpr std::size_t kProbedRows = 32;

Sha256Digest digest_of(std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digest();
}

void add_ring(Packer& packer, const Ring& ring) {
  packer.add(static_cast<std::uint64_t>(ring.size()));
  for (const Point& p : ring) {
    packer.add(p.x);
    packer.add(p.y);
  }
}

void add_measure(Packer& packer, const AnyShapeSimilarity& measure) {
  packer.add_text(measure.name());
  packer.add_text(to_string(measure.options()));
}

void add_measures(Packer& packer, const MatrixInputs& inputs) {
  add_measure(packer, inputs.measure);
  if (inputs.pruning) {
    add_measure(packer, inputs.pruning->cheap);
  } else {
    packer.add_text("");
    packer.add_text("");
  }
}

Sha256Digest digest_of(const MatrixInputs& inputs) {
  Packer packer;
  packer.add(kSimilarityFileVersion);
  add_measures(packer, inputs);
  packer.add(inputs.pruning ? inputs.pruning->keep : std::uint32_t{0});
  packer.add(static_cast<std::uint64_t>(inputs.clusters.members.size()));
  packer.add_all(std::span<const std::uint32_t>(inputs.clusters.cluster_of));
  packer.add(static_cast<std::uint64_t>(inputs.shapes.size()));
  for (const LabelledShape& shape : inputs.shapes) {
    add_ring(packer, shape.polygon.outer);
    packer.add(static_cast<std::uint64_t>(shape.polygon.holes.size()));
    for (const Ring& hole : shape.polygon.holes) add_ring(packer, hole);
    packer.add(static_cast<std::uint64_t>(shape.edges.size()));
    packer.add_all(std::span<const EdgeLabel>(shape.edges));
    packer.add_text(shape.zone);
  }
  return digest_of(packer.bytes());
}

Bytes packed(const SimilarityMatrix& matrix, const MatrixInputs& inputs) {
  Packer packer;
  packer.add_all(std::span(kMagic));
  packer.add(kSimilarityFileVersion);
  packer.add(kByteOrder);
  packer.add(digest_of(inputs));
  packer.add(static_cast<std::uint32_t>(matrix.layout));
  packer.add(matrix.keep);
  packer.add(static_cast<std::uint64_t>(matrix.size()));
  packer.add(static_cast<std::uint64_t>(matrix.members.size()));
  packer.add(static_cast<std::uint64_t>(matrix.failures.size()));
  add_measures(packer, inputs);
  packer.add_all(std::span<const std::uint32_t>(matrix.cluster_of));
  for (const ShapeFailure& failure : matrix.failures) {
    packer.add(failure.shape);
    packer.add(static_cast<std::uint32_t>(failure.failure.code));
    packer.add_text(failure.failure.message);
  }
  packer.add_all(std::span<const std::uint32_t>(matrix.columns));
  packer.add_all(std::span<const float>(matrix.entries));
  packer.add(digest_of(packer.bytes()));
  return packer.bytes();
}

Bytes bytes_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be read", path.string()));
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

bool has_magic(const Bytes& bytes) {
  return bytes.size() >= kMagic.size() &&
         std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

/// Magic, version, byte order and checksum; what lies between the first three and the last.
Unpacker checked_contents(const Bytes& bytes, const std::string& file) {
  if (!has_magic(bytes))
    throw InputError(fmt::format("{}: is no similarity matrix (it does not begin so)", file));
  const std::span<const std::byte> all(bytes);
  Unpacker head(all.subspan(kMagic.size()), file);
  const auto version = head.take<std::uint32_t>();
  const auto order = head.take<std::uint32_t>();
  if (version == kSimilarityFileVersion && order != kByteOrder)
    throw InputError(
        fmt::format("{}: was written by a machine of another byte order; compute it again", file));
  if (version != kSimilarityFileVersion)
    throw InputError(
        fmt::format("{}: has format version {}, this program reads {}; compute it again", file,
                    version, kSimilarityFileVersion));
  if (head.left() < sizeof(Sha256Digest)) head.refuse("it is cut off");
  Sha256Digest stored;
  std::memcpy(stored.data(), all.last(stored.size()).data(), stored.size());
  if (digest_of(all.first(all.size() - stored.size())) != stored)
    head.refuse("its contents do not match their checksum");
  const std::size_t begin = kMagic.size() + 2 * sizeof(std::uint32_t);
  return {all.subspan(begin, all.size() - begin - stored.size()), file};
}

std::string described(const std::string& name, const std::string& options) {
  return options.empty() ? name : name + " (" + options + ")";
}

void expect_measure(const std::string& file, std::string_view role, const std::string& found,
                    const std::string& wanted) {
  if (found != wanted)
    throw InputError(fmt::format("{}: its {} is {}, wanted is {}; compute it again", file, role,
                                 found.empty() ? "none" : found, wanted.empty() ? "none" : wanted));
}

void expect_measures(Unpacker& in, const std::string& file, const MatrixInputs& inputs) {
  const auto text_of = [](const AnyShapeSimilarity& measure) {
    return described(std::string(measure.name()), to_string(measure.options()));
  };
  const std::string name = in.take_text();
  expect_measure(file, "measure", described(name, in.take_text()), text_of(inputs.measure));
  const std::string cheap = in.take_text();
  expect_measure(file, "pruning", described(cheap, in.take_text()),
                 inputs.pruning ? text_of(inputs.pruning->cheap) : "");
}

MatrixLayout take_layout(Unpacker& in) {
  const auto number = in.take<std::uint32_t>();
  for (const auto layout :
       {MatrixLayout::kSquares, MatrixLayout::kTriangles, MatrixLayout::kNearest}) {
    if (number == static_cast<std::uint32_t>(layout)) return layout;
  }
  in.refuse(fmt::format("its layout {} is none of 1, 2, 3", number));
}

std::vector<ShapeFailure> take_failures(Unpacker& in, std::uint64_t count, std::uint64_t shapes) {
  std::vector<ShapeFailure> failures;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto shape = in.take<std::uint32_t>();
    const auto code = static_cast<FailureCode>(in.take<std::uint32_t>());
    if (shape >= shapes || (i > 0 && shape <= failures.back().shape))
      in.refuse("a failure of no shape");
    failures.push_back({shape, {code, in.take_text()}});
  }
  return failures;
}

/// Rows name members of their cluster, in order, and not themselves.
bool are_columns_valid(const SimilarityMatrix& matrix) {
  if (matrix.layout != MatrixLayout::kNearest) return true;
  for (std::uint32_t place = 0; place < matrix.size(); ++place) {
    for (std::uint64_t e = matrix.first_entry[place]; e < matrix.first_entry[place + 1]; ++e) {
      const std::uint32_t column = matrix.columns[e];
      if (column >= matrix.size() || column == place) return false;
      if (e > matrix.first_entry[place] && column <= matrix.columns[e - 1]) return false;
      const auto& members = matrix.members[matrix.cluster_of[place]];
      if (!std::binary_search(members.begin(), members.end(), column)) return false;
    }
  }
  return true;
}

SimilarityMatrix unpacked(Unpacker& in, const std::string& file, const MatrixInputs& inputs) {
  const auto digest = in.take<Sha256Digest>();
  const MatrixLayout layout = take_layout(in);
  const auto keep = in.take<std::uint32_t>();
  const auto shapes = in.take<std::uint64_t>();
  const auto clusters = in.take<std::uint64_t>();
  const auto failure_count = in.take<std::uint64_t>();
  expect_measures(in, file, inputs);
  if (digest != digest_of(inputs))
    throw InputError(fmt::format(
        "{}: is stale: the shapes, their labels, zones or clusters, or the number kept per row are "
        "not those it was computed for; compute it again",
        file));
  if (shapes != inputs.shapes.size() || clusters != inputs.clusters.members.size() ||
      layout != layout_of(inputs) || keep != (inputs.pruning ? inputs.pruning->keep : 0))
    in.refuse("its sizes are not those of its inputs");
  auto cluster_of = in.take_all<std::uint32_t>(shapes);
  if (cluster_of != inputs.clusters.cluster_of)
    in.refuse("its clusters are not those of its inputs");
  auto failures = take_failures(in, failure_count, shapes);
  SimilarityMatrix matrix =
      matrix_frame(std::move(cluster_of), clusters, std::move(failures), layout, keep);
  matrix.columns = in.take_all<std::uint32_t>(matrix.columns.size());
  matrix.entries = in.take_all<float>(matrix.entries.size());
  if (in.left() != 0) in.refuse("it goes on behind its end");
  if (!are_columns_valid(matrix)) in.refuse("a row names a shape that is not of its cluster");
  if (!std::all_of(matrix.entries.begin(), matrix.entries.end(),
                   [](float entry) { return std::isfinite(entry) && entry >= 0.0F; }))
    in.refuse("a distance is negative or not finite");
  return matrix;
}

[[noreturn]] void refuse_as_stale(const std::string& file, const std::string& why) {
  throw InputError(fmt::format("{}: is stale: {}; compute it again", file, why));
}

bool has_entries(const SimilarityMatrix& matrix, std::uint32_t place) {
  if (matrix.layout == MatrixLayout::kNearest)
    return matrix.first_entry[place] < matrix.first_entry[place + 1];
  return !detail::has_failed(matrix, place) && matrix.members[matrix.cluster_of[place]].size() > 1;
}

/// Rows with entries, evenly spread; all of them where they are few.
std::vector<std::uint32_t> probed_rows(const SimilarityMatrix& matrix) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t place = 0; place < matrix.size(); ++place) {
    if (has_entries(matrix, place)) rows.push_back(place);
  }
  const std::size_t count = std::min(kProbedRows, rows.size());
  std::vector<std::uint32_t> probed(count);
  for (std::size_t i = 0; i < count; ++i) probed[i] = rows[i * rows.size() / count];
  return probed;
}

void expect_same_failures(const SimilarityMatrix& matrix, const PreparedInputs& prepared,
                          const std::string& file) {
  const bool is_same =
      std::equal(matrix.failures.begin(), matrix.failures.end(), prepared.failures.begin(),
                 prepared.failures.end(), [](const ShapeFailure& a, const ShapeFailure& b) {
                   return a.shape == b.shape && a.failure.code == b.failure.code &&
                          a.failure.message == b.failure.message;
                 });
  if (!is_same)
    refuse_as_stale(file, fmt::format("its {} failures are not the {} that its measures give now",
                                      matrix.failures.size(), prepared.failures.size()));
}

void expect_same_columns(const SimilarityMatrix& matrix, const MatrixInputs& inputs,
                         const PreparedInputs& prepared, std::uint32_t place,
                         const std::string& file) {
  const auto held = std::span(matrix.columns)
                        .subspan(matrix.first_entry[place],
                                 matrix.first_entry[place + 1] - matrix.first_entry[place]);
  const std::vector<std::uint32_t> columns = detail::columns_of(matrix, inputs, prepared, place);
  if (!std::equal(held.begin(), held.end(), columns.begin(), columns.end()))
    refuse_as_stale(file, fmt::format("{} no longer chooses those that it holds for shape {}",
                                      inputs.pruning->cheap.name(), place));
}

/// Computes all failures and something of some rows again: a measure whose code has changed may
/// give others.
void expect_same_code(const SimilarityMatrix& matrix, const MatrixInputs& inputs,
                      const std::string& file, Jobs jobs) {
  const PreparedInputs prepared = detail::prepare_inputs(inputs, jobs);
  expect_same_failures(matrix, prepared, file);
  for (const std::uint32_t place : probed_rows(matrix)) {
    if (inputs.pruning) expect_same_columns(matrix, inputs, prepared, place, file);
    const std::vector<Candidate> row = matrix.nearest(place, matrix.size());
    for (const Candidate& held : {row.front(), row.back()}) {
      const float now = detail::entry_value(matrix.layout, inputs, prepared, place, held.shape);
      if (now != static_cast<float>(held.distance))
        refuse_as_stale(
            file, fmt::format("{} no longer gives the distance of shapes {} and {} that it holds",
                              inputs.measure.name(), held.shape, place));
    }
  }
}

}  // namespace

void write_similarity(const std::filesystem::path& path, const SimilarityMatrix& matrix,
                      const MatrixInputs& inputs) {
  const Bytes bytes = packed(matrix, inputs);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

SimilarityMatrix read_similarity(const std::filesystem::path& path, const MatrixInputs& inputs,
                                 Jobs jobs) {
  const Bytes bytes = bytes_of_file(path);
  Unpacker in = checked_contents(bytes, path.string());
  SimilarityMatrix matrix = unpacked(in, path.string(), inputs);
  expect_same_code(matrix, inputs, path.string(), jobs);
  return matrix;
}

LoadedSimilarity load_or_compute_similarity(const std::filesystem::path& path,
                                            const MatrixInputs& inputs, Jobs jobs,
                                            Progress::Style style) {
  LoadedSimilarity out;
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    if (!has_magic(bytes_of_file(path)))
      throw InputError(
          fmt::format("{}: is there and no similarity matrix; name another file", path.string()));
    try {
      out.matrix = read_similarity(path, inputs, jobs);
      return out;
    } catch (const InputError& error) {
      out.why_computed = error.what();
    }
  } else {
    out.why_computed = path.string() + ": was not there";
  }
  out.matrix = compute_matrix(inputs, jobs, style);
  write_similarity(path, out.matrix, inputs);
  return out;
}

}  // namespace plat::similarity
