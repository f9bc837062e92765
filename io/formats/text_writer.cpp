// OBJ and OFF: a line a vertex, then a line a face. Faces wait in a scratch file for the last
// vertex.
#include <charconv>
#include <string>
#include <string_view>
#include <utility>

#include "io/files/scratch_file.h"
#include "io/formats/counted_writer.h"
#include "io/formats/decimal_writer.h"
#include "io/formats/output_buffer.h"

namespace folprom::io {
namespace {

/// In what the two formats differ.
struct TextForm {
  const char* name;
  std::string header;
  std::string_view vertex;  ///< what stands before the coordinates
  std::string_view face;    ///< what stands before a face
  bool counts_corners;      ///< their number stands before the indices
  uint64_t first_index;
};

class TextWriter final : public CountedWriter {
 public:
  TextWriter(const std::string& path, const MeshShape& shape, bool force, TextForm form)
      : CountedWriter(path, shape, force),
        form_(std::move(form)),
        decimals_(shape.coordinate_type),
        face_file_(file().folder(), path),
        vertices_([this](std::span<const uint8_t> bytes) { file().Append(bytes).value(); }),
        faces_([this](std::span<const uint8_t> bytes) { face_file_.Append(bytes); }) {
    vertices_.Add(form_.header);
  }

  std::vector<std::string> Warnings() const override {
    std::vector<std::string> warnings = CountedWriter::Warnings();
    if (decimals_.payloads_lost() > 0) {
      warnings.push_back(std::string(form_.name) + " holds text: " +
                         std::to_string(decimals_.payloads_lost()) + " NaN lose their payload");
    }
    return warnings;
  }

 private:
  void WriteVertices(std::span<const double> xyz, std::span<const uint8_t>) override {
    for (size_t i = 0; i < xyz.size(); i += 3) {
      vertices_.Add(form_.vertex);
      for (size_t axis = 0; axis < 3; ++axis) {
        vertices_.Add(decimals_.Text(xyz[i + axis]));
        vertices_.Add(axis < 2 ? " " : "\n");
      }
    }
  }

  void WriteFaces(std::span<const Triangle> faces) override {
    for (const Triangle& face : faces) WritePolygon(face, {});
  }

  void WritePolygon(std::span<const uint64_t> corners, const FaceValues&) override {
    faces_.Add(form_.face);
    if (form_.counts_corners) AddNumber("", corners.size());
    for (const uint64_t index : corners) AddNumber(" ", index + form_.first_index);
    faces_.Add("\n");
  }

  void AddNumber(std::string_view before, uint64_t number) {
    char text[24];
    const auto end = std::to_chars(text, text + sizeof text, number);
    faces_.Add(before);
    faces_.Add({text, static_cast<size_t>(end.ptr - text)});
  }

  void Finish() override {
    vertices_.Flush();
    faces_.Flush();
    file().AppendFrom(face_file_).value();
  }

  TextForm form_;
  DecimalWriter decimals_;
  ScratchFile face_file_;
  OutputBuffer vertices_, faces_;
};

}  // namespace

std::unique_ptr<MeshWriter> MakeObjWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  // A file of no byte at all would be taken for a fault.
  const std::string header = "# " + std::to_string(shape.vertices) + " vertices, " +
                             std::to_string(shape.faces) + " faces\n";
  return std::make_unique<TextWriter>(path, shape, force,
                                      TextForm{"OBJ", header, "v ", "f", false, 1});
}

std::unique_ptr<MeshWriter> MakeOffWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  const std::string header =
      "OFF\n" + std::to_string(shape.vertices) + " " + std::to_string(shape.faces) + " 0\n";
  return std::make_unique<TextWriter>(path, shape, force, TextForm{"OFF", header, "", "", true, 0});
}

}  // namespace folprom::io
