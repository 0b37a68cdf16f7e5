#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sequences/diagnosis.h"

namespace plat::cli {

/// The bounds that a user calls "length_m" (wherever there are any) or "north:length_m".
/// @throws InputError where no bound is called so
std::vector<sequences::BoundPlace> places_named(const sequences::SequenceProblem& problem,
                                                const sequences::CompiledProblem& compiled,
                                                const std::string& name);

/// Why there is no sequence, for people and for programs.
std::string diagnosis_text(const sequences::SequenceProblem& problem,
                           const Expected<sequences::Diagnosis>& diagnosis);
nlohmann::ordered_json diagnosis_json(const sequences::SequenceProblem& problem,
                                      const Expected<sequences::Diagnosis>& diagnosis);

/// The sequence that misses its bounds least.
std::string relaxation_text(const sequences::CompiledProblem& compiled,
                            const sequences::SequenceProblem& problem,
                            const Expected<std::optional<sequences::Relaxation>>& relaxation);
nlohmann::ordered_json relaxation_json(
    const sequences::CompiledProblem& compiled, const sequences::SequenceProblem& problem,
    const Expected<std::optional<sequences::Relaxation>>& relaxation);

}  // namespace plat::cli
