#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "editing/edit.h"
#include "geodata/layer.h"

namespace plat::harness {

/// An edit of a script. What it names by place ("the node nearest to ...") is looked up when it is
/// its turn, after the edits before it.
struct ScriptedEdit {
  std::string name;  ///< "move_node"
  std::function<editing::Edit(const editing::City&, const geodata::LocalFrame&)> resolve;
};

/// The edits of a script (docs/edit_script.md). Every key is checked before anything runs.
/// @throws InputError with the number of the edit, the key and what is allowed
std::vector<ScriptedEdit> parse_edit_script(const nlohmann::json& script,
                                            const std::string& source);
std::vector<ScriptedEdit> read_edit_script(const std::string& file);

}  // namespace plat::harness
