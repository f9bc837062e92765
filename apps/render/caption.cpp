#include "apps/render/caption.h"

#include <array>
#include <cstddef>

namespace folprom::render {
namespace {

constexpr char kFirst = ' ', kLast = '~';
constexpr std::array<uint16_t, kLetterHeight> kLetters[] = {
#include "apps/render/font_9x15.inc"
};
static_assert(std::size(kLetters) == kLast - kFirst + 1);

// One byte a letter.
std::string Printable(std::string_view text) {
  std::string letters;
  for (const char c : text) {
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0U) == 0x80;  // UTF-8
    if (goes_on) continue;
    letters += c >= kFirst && c <= kLast ? c : '?';
  }
  return letters;
}

}  // namespace

void Write(Image* image, uint32_t x, uint32_t y, std::string_view text, uint8_t grey) {
  for (const char letter : Printable(text)) {
    const auto& rows = kLetters[letter - kFirst];
    for (uint32_t row = 0; row < kLetterHeight && y + row < image->height(); ++row) {
      for (uint32_t column = 0; column < kLetterWidth && x + column < image->width(); ++column) {
        const bool ink = (rows[row] >> (kLetterWidth - 1 - column) & 1U) != 0;
        if (ink) image->At(x + column, y + row) = {grey, 255};
      }
    }
    x += kLetterWidth;
  }
}

std::string Fitted(std::string_view text, uint32_t pixels) {
  std::string letters = Printable(text);
  const size_t room = pixels / kLetterWidth;
  if (letters.size() <= room) return letters;
  constexpr std::string_view kEllipsis = "...";
  if (room <= kEllipsis.size()) return letters.substr(0, room);
  return letters.substr(0, room - kEllipsis.size()) + std::string(kEllipsis);
}

}  // namespace folprom::render
