#include "parsers/parsers.h"

#include <algorithm>
#include <cctype>

#include "base/image/image.h"
#include "base/io/release_pages.h"
#include "base/text/blanks.h"
#include "base/text/letter_case.h"
#include "base/text/utf8.h"
#include "parsers/gltf/gltf.h"
#include "parsers/patches/patches.h"
#include "parsers/patches/patches_scene.h"
#include "parsers/vrml/parser.h"
#include "parsers/vrml/vrml1.h"
#include "parsers/x3d/parser.h"
#include "parsers/x3d/xml.h"

namespace wrlkit {
namespace {

std::string_view first_line(std::string_view s) {
  const auto end = std::ranges::find_if(s, [](char c) { return c == '\r' || c == '\n'; });
  return s.substr(0, static_cast<std::size_t>(end - s.begin()));
}

/// As far as it can be one: a .glb has megabytes without a line end.
std::string_view header_line(std::string_view text) {
  constexpr std::size_t longest = 65536;
  return trim(first_line(trim(text).substr(0, longest)));
}

std::string_view without_bom(std::string_view s) { return s.starts_with("\xef\xbb\xbf") ? s.substr(3) : s; }

bool has_utf16_bom(std::string_view s) { return s.starts_with("\xff\xfe") || s.starts_with("\xfe\xff"); }

bool contains_nocase(std::string_view text, std::string_view lower) {
  auto same = [](char a, char b) { return to_lower(a) == b; };
  return std::search(text.begin(), text.end(), lower.begin(), lower.end(), same) != text.end();
}

// Without a header: which dialect has the statement that begins behind the comments?
Format guess_format(std::string_view s) {
  s = trim(s);
  while (s.starts_with('#')) s = trim(s.substr(first_line(s).size()));
  auto word_end =
      std::ranges::find_if(s, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_'; });
  auto word = s.substr(0, static_cast<std::size_t>(word_end - s.begin()));
  auto rest = trim(s.substr(word.size()));
  if (word == "DEF" || word == "PROTO" || word == "EXTERNPROTO" || word == "ROUTE") return Format::vrml97;
  if (word == "PROFILE") return Format::x3d_classic;
  if (!rest.starts_with('{')) return Format::none;
  return find_builtin(word, Dialect::vrml97)  ? Format::vrml97
         : find_builtin(word, Dialect::vrml1) ? Format::vrml1
         : find_builtin(word, Dialect::x3d)   ? Format::x3d_classic
                                              : Format::none;
}

/// The comment lines behind the header, each with its '#', without trailing blanks.
std::string leading_comment(std::string_view s) {
  std::string out;
  for (s = trim(s); s.starts_with('#'); s = s.substr(std::min(s.size(), s.find_first_not_of("\r\n")))) {
    auto line = first_line(s);
    auto text = trim(line);
    out += is_utf8(text) ? std::string(text) : latin1_to_utf8(text);
    out += '\n';
    s.remove_prefix(line.size());
    if (s.empty()) break;
  }
  return out;
}

/// Of "#X3D V3.3 utf8".
int x3d_version(std::string_view line) {
  auto v = line.find('V');
  return x3d::version_number(v == line.npos ? line : line.substr(v + 1));
}

struct Header {
  Format format = Format::none;
  bool exact = false, missing = false;
};

/// With the prefix of a namespace, or without an X3D element around it: a Scene, or a node of a fragment.
bool is_x3d_element(std::string_view name) {
  name.remove_prefix(name.find(':') + 1);
  return name == "X3D" || name == "Scene" || name == "scene" || find_builtin(name, Dialect::x3d);
}

/// Whether VRML is the first word of a comment: others are about it.
bool begins_with_vrml(std::string_view comment) {
  const auto word = std::ranges::find_if(comment, [](char c) { return std::isalnum(static_cast<unsigned char>(c)); });
  return starts_with_ignoring_case(comment.substr(static_cast<std::size_t>(word - comment.begin())), "vrml");
}

Header read_header(std::string_view text) {
  const auto line = header_line(text);
  if (line.starts_with('#')) {
    if (line.starts_with("#VRML V2.0 utf8")) return {Format::vrml97, true, false};
    const bool is_vrml = begins_with_vrml(line);
    if (is_vrml && line.find("1.0") != line.npos) return {Format::vrml1, line.starts_with("#VRML V1.0 ascii"), false};
    if (line.starts_with("#Inventor")) return {Format::vrml1, true, false};
    if (line.starts_with("#X3D")) return {Format::x3d_classic, true, false};
    if (is_vrml) return {Format::vrml97, false, false};
  }
  if (line.starts_with('<') && (contains_nocase(text.substr(0, 65536), "<x3d") || is_x3d_element(first_element(text))))
    return {Format::x3d_xml, true, false};
  if (gltf_reader::looks_like_gltf(text)) return {Format::gltf, true, false};
  return {guess_format(text), false, true};
}

}  // namespace

Format sniff_format(std::string_view text) { return read_header(without_bom(text)).format; }

std::string_view to_string(Format f) {
  constexpr std::string_view names[] = {"none", "vrml1", "vrml97", "x3dv", "x3d", "gltf"};
  return names[static_cast<std::size_t>(f)];
}

namespace {

/// Text that can be shown on a terminal: the beginning of a line, without control characters.
bool is_plain_text(std::string_view line) {
  const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f; };
  return is_utf8(line) && std::ranges::none_of(line, is_control);
}

/// What the first bytes are, for the message that this is not a scene.
std::string describe_bytes(std::string_view text) {
  if (text.find_first_not_of(std::string_view("\0 \t\r\n", 5)) == text.npos) return "it holds nothing but blanks";
  auto mime = sniff_mime(text);
  if (!mime.empty()) return "it is a picture (" + std::string(mime) + ")";
  if (text.starts_with("WPW1")) return "it is a progressive stream (.wpm), which pages show and wrlkit does not read";
  const std::string_view line = first_line(text);
  if (!is_plain_text(line)) return "it holds binary data";
  std::string_view shown = line.substr(0, 40);
  while (!is_utf8(shown)) shown.remove_suffix(1);
  return "the first line is '" + std::string(shown) + "'";
}

/// Encodings of scenes that are known and not read; empty: it is none of them.
std::string_view unread_encoding(std::string_view body) {
  const auto line = header_line(body);
  if (line.starts_with("#Inventor") && contains_nocase(line, "binary")) return "Inventor's binary form";
  if (body.starts_with(std::string_view("\xe0\0\0\1", 4)) ||
      (body.starts_with("<?xml") && contains_nocase(line, "encoding='finf'")))
    return "X3D's binary encoding";
  const auto head = trim(body.substr(0, 4096));
  return head.starts_with('{') && trim(head.substr(1)).starts_with("\"X3D\"") ? "X3D's JSON encoding" : "";
}

std::unique_ptr<World> parse_gltf(std::string_view bytes, std::uint32_t base, const std::string& path,
                                  const ReadOptions& options, Diagnostics& diag) {
  auto world = std::make_unique<World>();
  world->format = world->scene.format = Format::gltf;
  world->scene.sources = diag.shared_sources();
  world->scene.file = Span{base, 0};
  gltf_reader::parse(bytes, base, path, options.allowed, options.lookups, options.parse, world->scene, diag);
  return world;
}

std::unique_ptr<World> parse_text(std::string_view text, std::uint32_t base, const std::string& path,
                                  const ReadOptions& options, Diagnostics& diag, const vrml::PartRead& part_read = {}) {
  std::string converted;
  Span whole{base, 0}, first{base, static_cast<std::uint32_t>(first_line(text.substr(0, 80)).size())};
  if (has_utf16_bom(text)) {
    diag.report(Diag::encoding_repaired, whole, "UTF-16");
    converted = utf16_to_utf8(text);
    text = converted;
  }
  auto body = without_bom(text);
  base += static_cast<std::uint32_t>(text.size() - body.size());
  if (const auto encoding = unread_encoding(body); !encoding.empty()) {
    diag.report(Diag::unsupported_format, first, encoding);
    return nullptr;
  }
  auto header = read_header(body);
  if (header.format == Format::none) {
    diag.report(Diag::unknown_format, whole, describe_bytes(body) + "; VRML, X3D, Inventor and glTF are read");
    return nullptr;
  }
  if (header.format == Format::gltf) return parse_gltf(body, base, path, options, diag);
  const bool old = header.format == Format::vrml1, xml = header.format == Format::x3d_xml,
             classic = header.format == Format::x3d_classic;
  if (header.missing)
    diag.report(Diag::header_missing, whole, old ? "VRML 1.0" : classic ? "X3D" : "VRML97");
  else if (!header.exact)
    diag.report(Diag::header_repaired, first, trim(first_line(body)), old ? "#VRML V1.0 ascii" : "#VRML V2.0 utf8");
  auto world = std::make_unique<World>();
  world->format = world->scene.format = header.format;
  world->scene.sources = diag.shared_sources();
  world->scene.file = whole;
  if (xml) {
    x3d::parse(body, base, options.parse, world->scene, diag);
    return world;
  }
  if (classic && !header.missing) world->scene.x3d.version = x3d_version(trim(first_line(trim(body))));
  auto after = header.missing ? body : trim(body).substr(first_line(trim(body)).size());
  world->scene.comment = leading_comment(after);
  if (old && !header.missing) world->scene.header = trim(first_line(trim(body)));
  if (old)
    vrml::parse_vrml1(body, base, options.parse, world->scene, diag);
  else
    vrml::parse(body, base, options.parse, world->scene, diag, converted.empty() ? part_read : vrml::PartRead());
  return world;
}

}  // namespace

std::unique_ptr<World> read_world(const std::string& path, const ReadOptions& options, Diagnostics& diag) {
  auto file = read_file(path, options.limits, diag);
  return file ? parse_world(*file, options, diag) : nullptr;
}

namespace {

std::unique_ptr<World> world_of_patches(const FileText& file, Diagnostics& diag) {
  const auto set = parse_patches(file, diag);
  if (!set) return nullptr;
  auto world = std::make_unique<World>();
  world->format = world->scene.format = Format::vrml97;
  world->scene.sources = diag.shared_sources();
  add_patches(*set, world->scene);
  return world;
}

}  // namespace

std::unique_ptr<World> parse_world(const FileText& file, const ReadOptions& options, Diagnostics& diag) {
  auto world = is_patch_file(file.view())
                   ? world_of_patches(file, diag)
                   : parse_text(file.view(), file.base, file.name == standard_input_name ? std::string() : file.name,
                                options, diag, release_pages);
  if (world) {
    world->gzip = file.gzip;
    world->bytes = file.bytes_on_disk;
  }
  return world;
}

std::unique_ptr<World> parse_world(std::string_view text, std::string name, const ReadOptions& options,
                                   Diagnostics& diag) {
  auto kept = std::make_shared<std::string>(text);
  const auto again = [kept] { return Sources::Loaded{*kept, kept}; };
  auto base = diag.sources().add(std::move(name), text.size(), again, true);
  if (base == Span::nowhere) {
    diag.report(Diag::too_large, {}, "the text", "4 GiB", text.size());
    return nullptr;
  }
  auto world = parse_text(*kept, base, {}, options, diag);
  if (world) world->bytes = text.size();
  return world;
}

}  // namespace wrlkit
