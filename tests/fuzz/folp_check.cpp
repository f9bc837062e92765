#include "tests/fuzz/folp_check.h"

#include <algorithm>
#include <bit>

#include "folprom/decoder.h"
#include "folprom/scalar_type.h"
#include "io/container/byte_code.h"
#include "io/container/checksum.h"
#include "io/container/header.h"
#include "io/container/layout.h"
#include "io/container/table_code.h"

namespace folprom::fuzz {
namespace {

template <class T>
void Store(T value, size_t offset, std::vector<uint8_t>* file) {
  std::vector<uint8_t> bytes;
  io::AppendLittleEndian(value, &bytes);
  std::copy(bytes.begin(), bytes.end(), file->begin() + static_cast<ptrdiff_t>(offset));
}

/// Of the bytes [begin, end), behind them.
void StoreShortChecksum(uint64_t begin, uint64_t end, std::vector<uint8_t>* file) {
  if (end + io::kGroupChecksumBytes > file->size()) return;
  const auto bytes = std::span<const uint8_t>(*file).subspan(begin, end - begin);
  Store(static_cast<uint32_t>(io::XxHash64(bytes)), end, file);
}

/// Tables as far as they are there; Failure where they contradict themselves.
io::FileLayout RepairTables(std::vector<uint8_t>* file) {
  const std::span<const uint8_t> bytes(*file);
  const size_t length = io::LoadLittleEndian<uint32_t>(&bytes[io::kTableBegin - io::kLengthBytes]);
  const uint64_t header_end = uint64_t{io::kTableBegin} + length;
  if (header_end + io::kHeaderChecksumBytes > bytes.size()) return io::FileLayout();
  Store(io::XxHash64(bytes.first(header_end)), header_end, file);

  io::TableDecoder decoder("repaired");
  decoder.Decode(bytes.subspan(io::kTableBegin, length), io::kTableBegin);
  io::FileLayout layout(header_end + io::kHeaderChecksumBytes);
  layout.AddLayers(decoder.table(), decoder.table().layers.size());
  while (decoder.next_bytes() > 0) {
    const uint64_t size = decoder.next_bytes(), begin = layout.end();
    if (size > bytes.size() || begin + size + io::kGroupChecksumBytes > bytes.size()) break;
    StoreShortChecksum(begin, begin + size, file);
    decoder.Decode(bytes.subspan(begin, size), begin);
    layout.AddTable(size);
    layout.AddLayers(decoder.table(), decoder.table().layers.size());
  }
  return layout;
}

bool IsFitting(const Error& error) {
  // kInput: the magic or the version is another one.
  return error.kind == ErrorKind::kCorrupt || error.kind == ErrorKind::kInput ||
         error.kind == ErrorKind::kLimit;
}

std::string FaultOfMesh(const DecodedMesh& mesh) {
  for (const auto& face : mesh.faces) {
    for (const uint64_t vertex : face) {
      if (vertex >= mesh.positions.size()) return "a face names a vertex that does not exist";
    }
  }
  for (const DecodedAttribute& attribute : mesh.attributes) {
    if (attribute.values.size() != mesh.positions.size() * ScalarSize(attribute.type)) {
      return "attribute " + attribute.name + " has not a value for each vertex";
    }
  }
  return "";
}

}  // namespace

void RepairChecksums(std::vector<uint8_t>* file) {
  if (file->size() < io::kTableBegin) return;
  try {
    const io::FileLayout layout = RepairTables(file);
    for (const io::ChecksumGroup& group : layout.groups()) {
      StoreShortChecksum(group.begin, group.end, file);
    }
  } catch (const Failure&) {
    // The tables contradict themselves: the reader comes no further either.
  }
}

std::string FaultOfFolp(std::span<const uint8_t> file) {
  std::vector<uint8_t> repaired(file.begin(), file.end());
  RepairChecksums(&repaired);
  auto decoder = MemoryDecoder::Open(repaired);
  if (!decoder) return IsFitting(decoder.error()) ? "" : decoder.error().message;
  while (decoder->decoded_layers() < decoder->layer_count()) {
    const Result<void> layer = decoder->DecodeNextLayer();
    if (!layer) return IsFitting(layer.error()) ? "" : layer.error().message;
    const size_t layers = decoder->decoded_layers();
    if (!std::has_single_bit(layers) && layers < decoder->layer_count())
      continue;  // enough of them
    const std::string fault = FaultOfMesh(decoder->Mesh());
    if (!fault.empty()) return fault;
  }
  return "";
}

}  // namespace folprom::fuzz
