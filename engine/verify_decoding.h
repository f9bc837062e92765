// Decodes a whole file to check it.
#pragma once

#include "engine/decode_pipeline.h"
#include "engine/folp_file.h"
#include "folprom/folprom.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Gives each part of the mesh to both sinks; second: may be null. Throws Failure.
void DecodeWhole(const FolpFile& file, const DecodeOptions& options, parallel::Runner& runner,
                 parallel::Progress& progress, MeshSink& first, MeshSink* second);

/// Is it the digest in the file; else the reason of the report says so.
bool IsDigestOf(const FolpFile& file, const io::MeshDigest& decoded, VerifyReport* report);

}  // namespace folprom
