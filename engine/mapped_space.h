// Arrays as long as the mesh in files, so that memory stays bounded.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/order/work_space.h"
#include "io/files/mapped_file.h"
#include "io/files/mapped_memory.h"
#include "io/spill/spill.h"

namespace folprom {

/// Lets pages go when the resident size of the process nears memory_bytes. No result depends on it.
class MappedSpace final : public WorkSpace {
 public:
  /// name: of the files, in the spill folder.
  MappedSpace(const io::SpillDirectory& spill, std::string name, uint64_t memory_bytes);

  std::span<uint32_t> Words(size_t count) override;
  void Stepped(size_t steps) override;
  void DropResident() const;
  /// Takes a file in, so that its pages go with the others.
  std::span<const uint8_t> Adopt(io::MappedFile file) {
    return files_.emplace_back(std::move(file)).bytes();
  }

 private:
  const io::SpillDirectory& spill_;
  std::string name_;
  uint64_t limit_;
  uint64_t next_drop_;  ///< resident bytes
  size_t steps_ = 0;
  std::vector<io::MappedMemory> arrays_;
  std::vector<io::MappedFile> files_;
};

}  // namespace folprom
