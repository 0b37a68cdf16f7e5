#include "sequences/sequence_search.h"

#include "sequences/forward_search.h"
#include "sequences/intermediate_graph_search.h"
#include "sequences/label_setting_search.h"
#include "sequences/layered_search.h"
#include "sequences/ranking_search.h"

namespace plat::sequences {

const Registry<AnySequenceSearch>& sequence_searches() {
  static const Registry<AnySequenceSearch> kMenu = [] {
    Registry<AnySequenceSearch> all;
    all.add<ForwardSearch>();
    all.add<LabelSettingSearch>();
    all.add<LayeredSearch>();
    all.add<IntermediateGraphSearch>();
    all.add<RankingSearch>();
    return all;
  }();
  return kMenu;
}

Expected<std::vector<SequencePath>> find_paths(SequenceStream& stream, std::size_t k) {
  std::vector<SequencePath> found;
  SequencePath path;
  while (found.size() < k) {
    const auto more = stream.next(path);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    found.push_back(path);
  }
  return found;
}

}  // namespace plat::sequences
