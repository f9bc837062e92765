#include "apps/batch/job_keys.h"

#include <algorithm>
#include <limits>

namespace folprom::batch {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr std::string_view kExisting[] = {"skip", "overwrite", "fail"};
constexpr std::string_view kOnError[] = {"continue", "stop"};
constexpr std::string_view kOfTheBatch[] = {"threads", "memory", "tmp"};

bool IsOfTheBatch(const cli::Key& key) {
  return key.table == "encode" && std::find(std::begin(kOfTheBatch), std::end(kOfTheBatch),
                                            key.name) != std::end(kOfTheBatch);
}

}  // namespace

std::vector<cli::Key> JobKeys(Job& job, std::string_view table) {
  std::vector<cli::Key> keys;
  if (table == kJob) {
    keys = {
        {table, "name", &job.name, "name of the job in reports and as {job}; else job1, job2", ""},
        {table, "input", &job.input,
         "scans: a pattern or a list of such, relative to this file; * and ? inside a name, ** "
         "for any folders; .folp files where operations has neither encode nor rd",
         ""}};
  }
  const std::vector<cli::Key> own = {
      {table, "exclude", &job.exclude, "patterns of scans to leave out", ""},
      {table, "output", &job.output,
       "folder of the outputs, relative to this file; made where it is missing", ""},
      {table, "pattern", &job.pattern,
       "path of an output below the folder, without extension: {stem} and {name} of the scan, "
       "{folder} below the fixed part of its pattern, {job}",
       ""},
      {table, "config", &job.config,
       "settings to start from, relative to this file; keys beside it win", ""},
      {table, "operations", &job.operations,
       "what to do: encode, decode the lods, verify against the scan, rd (error at each rate)", "",
       0, 0, kOperationNames},
      {table, "lods", std::monostate(), "what decode writes, one entry each; none: the whole mesh",
       ""},
      {table, "rates", &job.rates, "rates of rd", "bits per vertex of the scan", 1e-6, 1e6},
      {table, "samples", cli::Count{&job.samples},
       "points of rd on the area of each mesh; 0: ten per face, 500k .. 10M", "points", 0,
       kNoLimit},
      {table, "existing", &job.existing,
       "an output that stands already: skip it where it is up to date, overwrite it, or fail "
       "before "
       "any work",
       "", 0, 0, kExisting},
      {table, "on_error", &job.on_error,
       "after a failed scan: continue with the others, or stop and begin no other", "", 0, 0,
       kOnError},
  };
  keys.insert(keys.end(), own.begin(), own.end());
  for (cli::Key key : cli::EncodeKeys(job.encode)) {
    if (IsOfTheBatch(key)) continue;
    key.table = table;
    keys.push_back(key);
  }
  return keys;
}

std::vector<cli::Key> BatchKeys(JobFile& file) {
  return {
      {kDefaults, "threads", &file.threads, "of all scans together; 0: all", "threads", 0, 1024},
      {kDefaults, "memory", &file.memory_bytes, "resident size of all scans together to stay below",
       "bytes, or a text such as \"2GiB\"", 1, kNoLimit},
      {kDefaults, "tmp", &file.temporary_folder,
       "folder for temporary files; empty: $TMPDIR or /tmp", ""},
      {kDefaults, "report", &file.report,
       "folder of the report, relative to this file; empty: its name with .report for .toml", ""}};
}

std::vector<cli::Key> LodKeys(Lod& lod) {
  return {
      {kLods, "name", &lod.name,
       "the output is STEM.NAME.ply; empty: from the bound, STEM.bpv2.ply, and STEM.ply for the "
       "whole mesh",
       ""},
      {kLods, "bpv", &lod.bpv, "as many layers as fit into this rate; 0: no bound",
       "bits per vertex of the scan", 0, 1e6},
      {kLods, "max_error", &lod.max_error,
       "the first layer whose error bound is at most this; 0: no bound", "model units", 0,
       kLargestTolerance},
      {kLods, "max_vertices", cli::Count{&lod.max_vertices},
       "the last layer of at most this many; 0: no bound", "vertices, or a text such as \"20k\"", 0,
       kNoLimit},
      {kLods, "layers", &lod.layers, "the first layers; 0: no bound", "layers", 0, 4294967295.0},
      {kLods, "region", &lod.region,
       "only what lies in this box, \"x0,y0,z0,x1,y1,z1\"; empty: no box", "model units"}};
}

}  // namespace folprom::batch
