// What verbs print on standard output: one JSON object, or lines for a reader.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "folprom/attribute.h"
#include "folprom/measure.h"

namespace folprom::cli {

/// Keeps the keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// Writes to standard output; kOutput where it does not take all of it.
void Print(const std::string& text);
void PrintJson(const Json& object);

/// null for no value.
template <class T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Mean, rms and max in model units and as parts of the diagonal, null for a single point, which
/// has no size that a distance could be a part of.
Json DistanceJson(const DistanceStatistics& statistics, double diagonal);

/// Of each its name, its type and how many numbers each corner has; 0 where the face has one.
Json FaceAttributesJson(std::span<const FaceAttributeInfo> attributes);
/// Of each its name, its type and the bits spent on it per vertex; null for no vertices.
Json AttributesJson(std::span<const AttributeInfo> attributes, uint64_t vertices);
/// Text of a file, without what would garble a terminal.
std::string Printable(std::string text);

/// "1,234,567"
std::string Grouped(uint64_t number);
/// "12.3 MiB"
std::string BytesShort(uint64_t bytes);

}  // namespace folprom::cli
