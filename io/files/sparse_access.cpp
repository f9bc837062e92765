#include "io/files/sparse_access.h"

#include <sys/mman.h>

namespace folprom::io {

void ExpectSparseAccess(const MappedFile& file) {
  const auto bytes = file.bytes();
  if (!bytes.empty()) ::madvise(const_cast<uint8_t*>(bytes.data()), bytes.size(), MADV_RANDOM);
}

}  // namespace folprom::io
