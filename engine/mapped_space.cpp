#include "engine/mapped_space.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace folprom {
namespace {

/// A step may touch some hundred pages where the mesh has no locality at all, and each brings 15
/// others along.
constexpr size_t kStepsBetweenLooks = 64;

/// 0 where the system does not tell.
uint64_t ResidentBytes() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "r"),
                                                             &std::fclose);
  unsigned long long pages = 0;
  if (file == nullptr || std::fscanf(file.get(), "%*u %llu", &pages) != 1) return 0;
  return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

MappedSpace::MappedSpace(const io::SpillDirectory& spill, std::string name, uint64_t memory_bytes)
    : spill_(spill), name_(std::move(name)), limit_(memory_bytes / 8 * 7), next_drop_(limit_) {}

std::span<uint32_t> MappedSpace::Words(size_t count) {
  const std::string path = spill_.File(name_ + "." + std::to_string(arrays_.size()));
  const auto bytes = arrays_.emplace_back(path, count * sizeof(uint32_t)).bytes();
  return {reinterpret_cast<uint32_t*>(bytes.data()), count};
}

void MappedSpace::Stepped(size_t steps) {
  steps_ += steps;
  if (steps_ < kStepsBetweenLooks) return;
  steps_ = 0;
  if (ResidentBytes() < next_drop_) return;
  DropResident();
  // Where something else takes the memory, dropping again at once would be in vain.
  next_drop_ = std::max(limit_, ResidentBytes() + limit_ / 4);
}

void MappedSpace::DropResident() const {
  for (const io::MappedMemory& array : arrays_) array.DropResident();
  for (const io::MappedFile& file : files_) file.DropResident();
}

}  // namespace folprom
