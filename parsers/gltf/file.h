// The parts of a glTF file: the JSON, the binary chunk of a GLB, and the arrays of the JSON by index. References
// between them are indices, which may be out of range; `element` checks them.
#pragma once
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/text/json_reader.h"

namespace wrlkit::gltf_reader {

enum class Table : std::uint8_t {
  accessors,
  animations,
  buffers,
  bufferViews,
  cameras,
  images,
  lights,
  materials,
  meshes,
  nodes,
  samplers,
  scenes,
  skins,
  textures
};
inline constexpr std::size_t n_tables = 14;
/// "accessor", "node", ...: as messages name an element.
std::string_view word(Table);

inline constexpr std::uint32_t none = 0xffffffffu;

class File {
 public:
  /// `bytes` must outlive it; their first byte lies at `base` of the sources.
  File(std::string_view bytes, std::uint32_t base, Diagnostics& diag) : bytes_(bytes), base_(base), diag_(diag) {}

  /// Takes the file apart; false when nothing of it can be read. What is wrong is reported.
  bool read();

  Json root() const { return root_; }
  std::string_view binary_chunk() const { return binary_; }
  std::size_t count(Table t) const { return tables_[static_cast<std::size_t>(t)].size(); }
  /// No Json when there is none, which the caller knows to be so.
  Json at(Table t, std::size_t i) const { return i < count(t) ? tables_[static_cast<std::size_t>(t)][i] : Json(); }
  /// The index that a member holds; `none` when it is not there, or, which is reported, points at nothing.
  std::uint32_t index(Table, Json reference);

  /// Written by wrlkit, with extras or without.
  bool is_made_here() const { return made_here_; }
  /// Written by wrlkit with extras: what it leaves out has the default of VRML.
  bool is_own() const { return own_; }
  /// And with all extras, so that what meshes and materials leave out has the default of VRML, too; without that
  /// (--extras facts) they are what glTF says.
  bool is_whole() const { return whole_; }
  bool is_binary() const { return text_.data() != bytes_.data(); }

  Span where(Json j) const {
    return {static_cast<std::uint32_t>(base_ + (text_.data() - bytes_.data()) + j.offset()), j.length()};
  }
  Diagnostics& diag() { return diag_; }

 private:
  bool take_chunks();
  bool damaged(std::string_view what);

  std::string_view bytes_, text_, binary_;
  std::uint32_t base_;
  Diagnostics& diag_;
  JsonDocument document_;
  Json root_;
  std::array<std::vector<Json>, n_tables> tables_;
  bool made_here_ = false, own_ = false, whole_ = false;
};

inline bool is_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

}  // namespace wrlkit::gltf_reader
