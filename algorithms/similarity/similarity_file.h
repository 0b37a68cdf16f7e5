#pragma once

#include <filesystem>
#include <string>

#include "core/parallel.h"
#include "core/progress.h"
#include "similarity/similarity_matrix.h"

namespace plat::similarity {

/// The format of the file, counted up whenever it changes.
inline constexpr std::uint32_t kSimilarityFileVersion = 1;

/// Writes a matrix with what it was computed for: to a temporary beside the file, then renamed.
///
/// Format, in the byte order of the machine: 8 bytes "platsim\n"; u32 version; u32 0x01020304,
/// which tells the byte order; 32 bytes, SHA-256 of all inputs: every coordinate, label and zone,
/// the cluster of every shape, name and options of the measure and of the pruning; u32 layout; u32
/// keep; u64 shapes; u64 clusters; u64 failures; four texts (u32 length, bytes): measure, its
/// options, cheap measure, its options; per shape u32 cluster; per failure u32 shape, u32 code,
/// text; u32 per column; float per entry (SimilarityMatrix says where which is); 32 bytes, SHA-256
/// of all before.
/// @param matrix  compute_matrix(inputs)
/// @throws InputError where the path cannot be written
void write_similarity(const std::filesystem::path& path, const SimilarityMatrix& matrix,
                      const MatrixInputs& inputs);

/// The matrix in a file.
///
/// Guarantees: 1. a file that was computed for other inputs, is cut off, or has a changed byte is
/// refused;  2. what write_similarity wrote is read back, every bit, as long as the code of the
/// measures has not changed;  3. code that has changed under the same name and options is found
/// where it shows in what is computed again: all failures; of 32 rows with entries, evenly spread
/// (of all where there are fewer), the nearest and the farthest distance and, pruned, which shapes
/// are kept.
/// Not claimed: that code whose change shows in none of these is found.
///
/// Complexity: prepares every shape; at most 64 distances; pruned, at most 32 rows of cheap ones
///
/// @throws InputError saying which of these it is
SimilarityMatrix read_similarity(const std::filesystem::path& path, const MatrixInputs& inputs,
                                 Jobs jobs = {});

struct LoadedSimilarity {
  SimilarityMatrix matrix;
  /// Why it was computed, and the file written; empty where it was read.
  std::string why_computed;
};

/// Reads the matrix where the file holds it, else computes and writes it.
/// @throws InputError where the file is there and no similarity matrix: it is not overwritten; or
///   where it cannot be written
LoadedSimilarity load_or_compute_similarity(const std::filesystem::path& path,
                                            const MatrixInputs& inputs, Jobs jobs = {},
                                            Progress::Style style = Progress::Style::kQuiet);

}  // namespace plat::similarity
