#include "geodata/dataset_catalogue.h"

#include <gmock/gmock.h>

#include <set>

#include "core/failure.h"
#include "geodata/scratch_folder.h"
#include "support/data_folder.h"

namespace plat::geodata {
namespace {

using ::testing::HasSubstr;

TEST(DatasetCatalogue, NamesSourceLicenceAndChecksumOfEverySet) {
  EXPECT_EQ(catalogue().size(), 13U);
  std::set<std::string> names;
  for (const Dataset& set : catalogue()) {
    EXPECT_TRUE(names.insert(set.name).second) << set.name;
    for (const std::string& text :
         {set.title, set.contents, set.licence, set.attribution, set.source})
      EXPECT_FALSE(text.empty()) << set.name;
    ASSERT_FALSE(set.files.empty()) << set.name;
    for (const DatasetFile& file : set.files) {
      EXPECT_EQ(file.sha256.size(), 64U) << file.path;
      EXPECT_TRUE(file.path.starts_with(set.name + "/")) << file.path;
      if (std::holds_alternative<FetchFiles>(set.fetch)) {
        EXPECT_TRUE(file.url || file.is_optional) << file.path;
      }
    }
  }
}

TEST(DatasetCatalogue, SanFranciscoHasNoCadastre) {
  const Dataset& set = dataset("san_francisco_us");
  ASSERT_TRUE(set.observed);
  EXPECT_EQ(set.observed->plots, PlotOrigin::kTessellated);
  EXPECT_FALSE(set.observed->parcels);
  EXPECT_TRUE(set.observed->footprints);
  EXPECT_EQ(dataset("cambridge_ma").observed->plots, PlotOrigin::kObserved);
}

TEST(DatasetCatalogue, AMisspeltNameIsAnInputError) {
  try {
    dataset("cambrige_ma");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"cambridge_ma\"?"));
  }
}

TEST(DatasetCatalogue, TellsMissingAndChangedFiles) {
  const testing::ScratchFolder folder;
  const Dataset& set = dataset("campo_grande_br");
  EXPECT_FALSE(locate(set, folder.file("")));
  EXPECT_EQ(check(set, folder.file("")).at(0).state, FileState::kMissing);
  std::filesystem::create_directory(folder.file("campo_grande_br"));
  ASSERT_FALSE(folder.write("campo_grande_br/campo-grande.osm.gz", "other").empty());
  EXPECT_TRUE(locate(set, folder.file("")));
  EXPECT_EQ(check(set, folder.file("")).at(0).state, FileState::kDiffers);
}

TEST(DatasetCatalogue, ADerivedFileIsGoodWhileItsProvenanceFits) {
  const testing::ScratchFolder folder;
  Dataset set;
  set.name = "s";
  set.files = {{"s/a.gpkg", std::string(64, '0'), std::nullopt, false}};
  FetchTiles tiles;
  tiles.source_sha256 = "abc";
  set.fetch = tiles;
  std::filesystem::create_directory(folder.file("s"));
  ASSERT_FALSE(folder.write("s/a.gpkg", "abc").empty());
  const std::string sha = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  const auto state_with = [&](const std::string& source, const std::string& own) {
    EXPECT_FALSE(folder
                     .write("s/.provenance.json",
                            R"({"source":")" + source + R"(","files":{"a.gpkg":")" + own + "\"}}")
                     .empty());
    return check(set, folder.file("")).at(0).state;
  };
  EXPECT_EQ(state_with("abc", sha), FileState::kDerived);
  EXPECT_EQ(state_with("other", sha), FileState::kDiffers);
  EXPECT_EQ(state_with("abc", "other"), FileState::kDiffers);
}

TEST(DatasetCatalogue, RealFilesHaveTheirChecksumsLayersAndMappedFields) {
  PLAT_REAL_DATA_OR_SKIP(path, "cambridge_ma/cambridge_ma.gpkg");
  for (const Dataset& set : catalogue()) {
    if (!locate(set)) continue;
    for (const FileCheck& file : check(set)) EXPECT_EQ(file.state, FileState::kOk) << file.path;
    for (const DatasetLayer& layer : set.layers) {
      const auto infos = list_layers((data_dir() / layer.file).string());
      const auto found = std::find_if(infos.begin(), infos.end(), [&](const LayerInfo& info) {
        return info.name == layer.name;
      });
      ASSERT_NE(found, infos.end()) << layer.file << ":" << layer.name;
      EXPECT_EQ(found->feature_count, layer.feature_count) << layer.name;
    }
    if (!set.observed) continue;
    const auto read = [&](const std::optional<LayerMapping>& mapping, GeometryKind kind) {
      if (!mapping) return;
      ReadOptions options{.kind = kind, .where = mapping->where};
      for (const auto& [ours, theirs] : mapping->fields) options.fields.push_back(theirs);
      EXPECT_GT(read_layer(source_of(*mapping), options).features.size(), 10U) << mapping->layer;
    };
    read(set.observed->parcels, GeometryKind::kPolygon);
    read(set.observed->streets, GeometryKind::kLine);
    read(set.observed->footprints, GeometryKind::kPolygon);
    read(set.observed->blocks, GeometryKind::kPolygon);
  }
}

}  // namespace
}  // namespace plat::geodata
