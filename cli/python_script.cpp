#include "python_script.h"

#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "core/failure.h"

namespace plat::cli {
namespace {

/// What a child ends with when the program it should become cannot be started, as in a shell.
constexpr int kNotStarted = 127;

}  // namespace

int run_python(const std::filesystem::path& script, std::span<const std::string> arguments) {
  std::vector<std::string> words{PLAT_PYTHON, script.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(PLAT_PYTHON, pointers.data());
    _exit(kNotStarted);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0)
    throw InputError(script.string() + ": Python could not be started");
  const int result = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  if (result == kNotStarted)
    throw InputError(std::string(PLAT_PYTHON) +
                     ": not found: apt install python3-matplotlib python3-geopandas");
  return result;
}

}  // namespace plat::cli
