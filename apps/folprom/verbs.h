// The verbs of the program. Each file reads its flags, calls the engine once and prints a report.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace folprom::cli {

/// A verb as the command line knows it, and what it does after parsing. `run` gives the exit code
/// and throws Failure.
struct Verb {
  CLI::App* parser = nullptr;
  std::function<int()> run;
};

Verb AddEncode(CLI::App& program);
Verb AddDecode(CLI::App& program);
Verb AddInfo(CLI::App& program);
Verb AddVerify(CLI::App& program);
Verb AddCompare(CLI::App& program);
Verb AddRd(CLI::App& program);
Verb AddRender(CLI::App& program);
Verb AddSynth(CLI::App& program);
Verb AddBatch(CLI::App& program);

}  // namespace folprom::cli
