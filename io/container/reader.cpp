#include "io/container/reader.h"

#include <algorithm>
#include <new>
#include <utility>

#include "io/container/byte_code.h"
#include "io/container/checksum.h"
#include "io/container/header.h"
#include "io/container/table_code.h"

namespace folprom::io {

Result<ContainerReader> ContainerReader::Open(std::span<const uint8_t> bytes, std::string name) {
  try {
    ContainerReader reader;
    reader.Load(bytes, name);
    return reader;
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::kLimit, name + ": too little memory for the table"};
  }
}

void ContainerReader::Load(std::span<const uint8_t> bytes, std::string name) {
  bytes_ = bytes;
  name_ = std::move(name);
  LoadTables();
  if (has_all_tables() && bytes.size() > file_bytes()) {
    throw Failure(ErrorKind::kCorrupt, name_ + ": " + std::to_string(bytes.size() - file_bytes()) +
                                           " bytes after the end at byte " +
                                           std::to_string(file_bytes()));
  }
  const auto& ends = layout_.layer_end();
  complete_layers_ = static_cast<size_t>(
      std::upper_bound(ends.begin(), ends.end(), uint64_t{bytes.size()}) - ends.begin());
  verified_.reset(new std::atomic<bool>[layout_.groups().size()]());
}

void ContainerReader::LoadTables() {
  // Half of what an input may take.
  constexpr uint64_t kTableBytes = uint64_t{32} << 20, kTableBytesPerByte = 32;
  TableDecoder decoder(name_, kTableBytes + kTableBytesPerByte * bytes_.size());
  const auto first = TableBytes(bytes_, name_);
  header_bytes_ = kTableBegin + first.size() + kHeaderChecksumBytes;
  decoder.Decode(first, kTableBegin);
  layout_ = FileLayout(header_bytes_);
  layout_.AddLayers(decoder.table(), decoder.table().layers.size());
  while (decoder.next_bytes() > 0) {
    const uint64_t size = decoder.next_bytes(), begin = layout_.end();
    if (size > bytes_.size() || begin + size + kGroupChecksumBytes > bytes_.size()) break;
    const auto table = bytes_.subspan(begin, size);
    if (static_cast<uint32_t>(XxHash64(table)) !=
        LoadLittleEndian<uint32_t>(bytes_.data() + begin + size)) {
      throw Failure(ErrorKind::kCorrupt, name_ + ": checksum of the table (bytes " +
                                             std::to_string(begin) + " to " +
                                             std::to_string(begin + size) + ") differs");
    }
    decoder.Decode(table, begin);
    layout_.AddTable(size);
    layout_.AddLayers(decoder.table(), decoder.table().layers.size());
  }
  layers_total_ = decoder.layers_total();
  table_ = std::move(decoder).TakeTable();
  if (has_all_tables()) layout_.AddSections(table_);
}

bool ContainerReader::HasSection(SectionKind kind) const {
  const auto& section = table_.Section(kind);
  if (!section || !has_all_tables()) return false;
  const uint64_t begin = layout_.section_begin()[static_cast<size_t>(kind)];
  return begin <= bytes_.size() && section->bytes <= bytes_.size() - begin;
}

std::span<const uint8_t> ContainerReader::Section(SectionKind kind) const {
  return bytes_.subspan(layout_.section_begin()[static_cast<size_t>(kind)],
                        table_.Section(kind)->bytes);
}

std::string ContainerReader::PlaceOf(size_t layer, size_t subtree, SegmentPart part) const {
  return name_ + ": layer " + std::to_string(layer) + ", subtree " + std::to_string(subtree) +
         (part == SegmentPart::kInner ? ", inner segment: " : ", seam segment: ");
}

size_t ContainerReader::GroupOf(uint64_t position) const {
  const auto& groups = layout_.groups();
  const auto after = std::upper_bound(
      groups.begin(), groups.end(), position,
      [](uint64_t wanted, const ChecksumGroup& group) { return wanted < group.begin; });
  return static_cast<size_t>(after - groups.begin()) - 1;
}

bool ContainerReader::Intact(size_t group) const {
  if (verified_[group].load(std::memory_order_relaxed)) return true;
  const auto [begin, end] = layout_.groups()[group];
  if (static_cast<uint32_t>(XxHash64(bytes_.subspan(begin, end - begin))) !=
      LoadLittleEndian<uint32_t>(bytes_.data() + end)) {
    return false;
  }
  verified_[group].store(true, std::memory_order_relaxed);
  return true;
}

Result<std::span<const uint8_t>> ContainerReader::Segment(size_t layer, size_t subtree,
                                                          SegmentPart part) const {
  if (layer >= layers_total_ || subtree >= table_.subtrees.size()) {
    return Error{ErrorKind::kInternal, PlaceOf(layer, subtree, part) + "does not exist"};
  }
  if (layer >= table_.layers.size()) {
    return Error{ErrorKind::kCorrupt, PlaceOf(layer, subtree, part) + "the file is cut at byte " +
                                          std::to_string(bytes_.size()) + ", before its table"};
  }
  const size_t index = table_.SegmentIndex(layer, subtree, part);
  const uint64_t begin = layout_.segment_begin()[index];
  const uint64_t size = table_.segment_bytes[index];
  if (size == 0) return std::span<const uint8_t>();
  const size_t group = GroupOf(begin);
  const auto [group_begin, group_end] = layout_.groups()[group];
  if (group_end + kGroupChecksumBytes > bytes_.size()) {
    return Error{ErrorKind::kCorrupt, PlaceOf(layer, subtree, part) + "the file is cut at byte " +
                                          std::to_string(bytes_.size()) + " of " +
                                          std::to_string(file_bytes())};
  }
  if (!Intact(group)) {
    return Error{ErrorKind::kCorrupt, PlaceOf(layer, subtree, part) + "checksum of bytes " +
                                          std::to_string(group_begin) + " to " +
                                          std::to_string(group_end) + " differs"};
  }
  return bytes_.subspan(begin, size);
}

}  // namespace folprom::io
