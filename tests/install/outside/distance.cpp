// distance A B: two meshes that are the same surface.
#include <cstdio>

#include "folprom/measure.h"
#include "folprom/parallel/progress.h"
#include "folprom/parallel/runner.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto runner = folprom::parallel::MakeSerialRunner();
  folprom::parallel::Progress progress;
  folprom::CompareOptions options;
  options.samples = 10000;
  auto compared = folprom::CompareFiles(argv[1], argv[2], options, *runner, progress);
  if (!compared) {
    std::fprintf(stderr, "%s\n", compared.error().message.c_str());
    return 1;
  }
  std::printf("rms %g, diagonal %g\n", compared->forward.rms, compared->diagonal);
  return compared->diagonal > 8 && compared->forward.max < 1e-5 ? 0 : 1;
}
