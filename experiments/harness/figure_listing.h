#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plat::harness {

/// One line of paper_figures/figures.json: a figure of a paper that Plat draws again.
struct PaperFigure {
  std::string id;  ///< "vkw12/fig10": the paper's folder and the figure
  std::string title;
  std::filesystem::path script;
  std::vector<std::string> datasets;  ///< what stands in for the paper's city; empty = made blocks
  double run_time_s = 0.0;            ///< as measured once
  std::size_t claim_count = 0;        ///< what the caption says and the script measures
};

/// The folder with the papers' figures: PLAT_FIGURES_DIR where set, else where it was built from.
std::filesystem::path figures_folder();

/// Every figure of `folder`/figures.json, in its order.
/// @throws InputError where the listing is missing, is no JSON, or lacks a key
std::vector<PaperFigure> read_figures(const std::filesystem::path& folder);

/// The figures that `names` ask for, in the listing's order, each once: "vkw12/fig10" is one
/// figure, "vkw12" all of a paper.
/// @throws InputError for a name that is neither
std::vector<PaperFigure> choose_figures(const std::vector<PaperFigure>& all,
                                        const std::vector<std::string>& names);

}  // namespace plat::harness
