#include "engine/codec/border_file.h"

#include <cstring>
#include <type_traits>

#include "io/container/checksum.h"

namespace folprom {
namespace {

template <class T>
void Append(std::vector<uint8_t>* bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  uint64_t count = values.size();
  const uint8_t* size = reinterpret_cast<const uint8_t*>(&count);
  const uint8_t* data = reinterpret_cast<const uint8_t*>(values.data());
  bytes->insert(bytes->end(), size, size + sizeof count);
  bytes->insert(bytes->end(), data, data + values.size() * sizeof(T));
}

template <class T>
void Take(const uint8_t** cursor, std::vector<T>* values) {
  uint64_t count = 0;
  std::memcpy(&count, *cursor, sizeof count);
  *cursor += sizeof count;
  values->resize(count);
  if (count > 0) std::memcpy(values->data(), *cursor, count * sizeof(T));
  *cursor += count * sizeof(T);
}

}  // namespace

std::string BorderName(uint32_t subtree) { return "border." + std::to_string(subtree); }

uint64_t SpillBorder(const io::SpillDirectory& spill, uint32_t subtree, const BorderRecord& record,
                     const BorderVertices& vertices) {
  std::vector<uint8_t> bytes;
  Append(&bytes, record.events);
  Append(&bytes, record.layer_end);
  Append(&bytes, std::vector<Int3>{record.root_position});
  Append(&bytes, vertices.original);
  Append(&bytes, vertices.position);
  Append(&bytes, vertices.exact);
  io::WriteSpillFile(spill, BorderName(subtree), bytes);
  return io::XxHash64(bytes);
}

uint64_t BorderBytes(const io::SpillDirectory& spill, const std::vector<uint32_t>& subtrees) {
  uint64_t bytes = 0;
  for (uint32_t subtree : subtrees) bytes += spill.FileBytes(BorderName(subtree));
  return bytes;
}

BorderFile LoadBorder(const io::SpillDirectory& spill, uint32_t subtree) {
  const io::MappedFile file = io::MapSpillFile(spill.File(BorderName(subtree)));
  const uint8_t* cursor = file.bytes().data();
  BorderFile border;
  std::vector<Int3> root;
  Take(&cursor, &border.record.events);
  Take(&cursor, &border.record.layer_end);
  Take(&cursor, &root);
  Take(&cursor, &border.vertices.original);
  Take(&cursor, &border.vertices.position);
  Take(&cursor, &border.vertices.exact);
  border.record.root_position = root.at(0);
  return border;
}

}  // namespace folprom
