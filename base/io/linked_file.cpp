#include "base/io/linked_file.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "base/image/image.h"
#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

using namespace std::literals;

struct Magic {
  std::string_view bytes;
  std::size_t at;
};

constexpr Magic sounds_and_films[] = {
    {"WAVE"sv, 8},           // in RIFF
    {"AVI "sv, 8},           // in RIFF
    {"AIFF"sv, 8},           // in FORM
    {"MThd"sv, 0},           // MIDI
    {"OggS"sv, 0},           // Ogg
    {"fLaC"sv, 0},           // FLAC
    {".snd"sv, 0},           // Sun, NeXT
    {"ID3"sv, 0},            // MPEG audio with a tag
    {"\xff\xfb"sv, 0},       // MPEG audio, layer 3
    {"\xff\xf3"sv, 0},       // the same at low rates
    {"\xff\xf2"sv, 0},       // the same with a check
    {"\0\0\1\xba"sv, 0},     // MPEG program
    {"\0\0\1\xb3"sv, 0},     // MPEG video
    {"ftyp"sv, 4},           // MPEG-4, QuickTime
    {"moov"sv, 4},           // QuickTime
    {"\x1a\x45\xdf\xa3", 0}  // Matroska, WebM
};

constexpr std::string_view world_headers[] = {"#VRML ", "#X3D ", "#Inventor ", "glTF"};
constexpr std::string_view packed_endings[] = {".wrl", ".wrz", ".gz", ".x3dz", ".x3dvz", ".vrml", ".x3d", ".x3dv"};

template <class Table>
bool is_one_of(std::string_view bytes, const Table& magics) {
  return std::ranges::any_of(magics, [&](const Magic& m) {
    return bytes.size() >= m.at + m.bytes.size() && bytes.substr(m.at, m.bytes.size()) == m.bytes;
  });
}

bool is_world(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("\x1f\x8b"))
    return std::ranges::any_of(packed_endings, [&](auto e) { return ends_with_ignoring_case(name, e); });
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.starts_with('<')) return bytes.find("<X3D") != bytes.npos;
  return std::ranges::any_of(world_headers, [&](auto h) { return bytes.starts_with(h); });
}

}  // namespace

bool is_linked_kind(const std::string& path) {
  std::string bytes(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return is_one_of(bytes, sounds_and_films) || is_world(bytes, path) || !sniff_mime(bytes, path).empty();
}

}  // namespace wrlkit
