#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "geodata/dataset_catalogue.h"

namespace plat::geodata {

/// Gets a data set from its public source into `folder`/<name>/: files as they are, verified by
/// their checksum; others made from their source, with a .provenance.json beside them that check()
/// reads. Files that are already good are left alone.
///
/// Guarantee: a file appears whole and verified, or not at all.
/// @returns  the files written, relative to `folder`
/// @throws   InputError, one line: source not reachable, checksum differs, or no automatic way; it
///           names the public source and where to put the file
std::vector<std::string> fetch(const Dataset& dataset,
                               const std::filesystem::path& folder = data_dir(),
                               Progress::Style style = Progress::Style::kAutomatic);

}  // namespace plat::geodata
