#include "engine/partition/resident_pages.h"

#include <algorithm>

namespace folprom::partition {

ResidentPages::ResidentPages(const io::MappedFile& file, uint64_t limit_bytes)
    : file_(file),
      limit_regions_(std::max<uint64_t>(limit_bytes >> kRegionBits, 1)),
      touched_((file.bytes().size() >> kRegionBits) + 1) {}

void ResidentPages::Mark(std::atomic<uint8_t>& region) {
  if (region.exchange(1, std::memory_order_relaxed) != 0) return;
  if (count_.fetch_add(1, std::memory_order_relaxed) + 1 < limit_regions_) return;
  const std::unique_lock lock(dropping_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  count_.store(0, std::memory_order_relaxed);
  for (std::atomic<uint8_t>& touched : touched_) touched.store(0, std::memory_order_relaxed);
  file_.DropResident();
}

void ResidentSource::Touched(uint64_t bytes) {
  if (touched_.fetch_add(bytes, std::memory_order_relaxed) + bytes < limit_) return;
  touched_.store(0, std::memory_order_relaxed);
  source_.DropResident();
}

}  // namespace folprom::partition
