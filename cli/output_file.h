#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace plat::cli {

/// Refuses, before any work is done, an output that could not be written afterwards: another ending
/// than the wanted one, a folder that is not there or closed to writing, or one of the input files
/// ("FILE[:layer]", empty ones are skipped), which would be lost.
/// @param flag  what the user called the output, for the message
/// @throws InputError
void expect_output(const std::string& path, std::initializer_list<std::string> inputs,
                   std::string_view flag = "--out", std::string_view ending = ".gpkg");

}  // namespace plat::cli
