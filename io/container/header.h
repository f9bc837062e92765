// The header of a .folp file: magic, version, first table and the checksum over them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace folprom::io {

/// A byte that no text begins with, the name, and line ends that a text transfer would alter.
inline constexpr std::array<uint8_t, 8> kMagic = {0xf7, 'F', 'O', 'L', 'P', '\r', '\n', 0x1a};
inline constexpr size_t kVersionBytes = 2;
inline constexpr size_t kLengthBytes = 4;
inline constexpr size_t kHeaderChecksumBytes = 8;
inline constexpr size_t kTableBegin = kMagic.size() + kVersionBytes + kLengthBytes;

/// All bytes before the first segment, around the bytes of the first table. Failure kLimit: those
/// are 4 GiB or more.
std::vector<uint8_t> EncodeHeader(std::span<const uint8_t> table_bytes);

/// The bytes of the first table inside `file_bytes`, after magic, version, length and checksum were
/// checked. Failure kInput: another kind of file or a newer version; kCorrupt: cut or damaged.
std::span<const uint8_t> TableBytes(std::span<const uint8_t> file_bytes, std::string_view file);

}  // namespace folprom::io
