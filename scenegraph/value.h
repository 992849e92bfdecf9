// Field values. A Value is 16 bytes: small ones are held inside it, everything else is an immutable array in the arena
// of the scene, so that copying a value, a node or a whole scene never copies the arrays.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/math/vec.h"
#include "scenegraph/ids.h"

namespace wrlkit {

// The field types of ISO/IEC 14772-1 clause 5 and of 19775-1 clause 5; SFBitMask, SFEnum and SFMatrix are VRML 1.0's.
// SF and MF of a kind are neighbours. `verbatim` is the source text of a value whose type nobody declared.
// clang-format off
#define WRLKIT_FIELD_TYPES(X) \
  X(SFBool, integer, 1) X(MFBool, integer, 1) \
  X(SFInt32, integer, 1) X(MFInt32, integer, 1) \
  X(SFFloat, number, 1) X(MFFloat, number, 1) \
  X(SFDouble, number, 1) X(MFDouble, number, 1) \
  X(SFTime, number, 1) X(MFTime, number, 1) \
  X(SFVec2f, number, 2) X(MFVec2f, number, 2) \
  X(SFVec2d, number, 2) X(MFVec2d, number, 2) \
  X(SFVec3f, number, 3) X(MFVec3f, number, 3) \
  X(SFVec3d, number, 3) X(MFVec3d, number, 3) \
  X(SFVec4f, number, 4) X(MFVec4f, number, 4) \
  X(SFVec4d, number, 4) X(MFVec4d, number, 4) \
  X(SFColor, number, 3) X(MFColor, number, 3) \
  X(SFColorRGBA, number, 4) X(MFColorRGBA, number, 4) \
  X(SFRotation, number, 4) X(MFRotation, number, 4) \
  X(SFMatrix3f, number, 9) X(MFMatrix3f, number, 9) \
  X(SFMatrix4f, number, 16) X(MFMatrix4f, number, 16) \
  X(SFString, text, 1) X(MFString, text, 1) \
  X(SFNode, node, 1) X(MFNode, node, 1) \
  X(SFImage, image, 1) X(MFImage, image, 1) \
  X(SFBitMask, text, 1) \
  X(SFEnum, text, 1) \
  X(SFMatrix, number, 16) \
  X(verbatim, text, 1)
// clang-format on

enum class FieldType : std::uint8_t {
#define WRLKIT_X(name, element, arity) name,
  WRLKIT_FIELD_TYPES(WRLKIT_X)
#undef WRLKIT_X
};

enum class Element : std::uint8_t { integer, number, text, node, image };

struct FieldTypeInfo {
  std::string_view name;
  Element element;
  std::uint8_t arity;  // numbers in one element: 3 for SFVec3f and for MFVec3f
  bool multiple;       // MF...
};

inline constexpr FieldTypeInfo field_type_infos[] = {
#define WRLKIT_X(name, element, arity) {#name, Element::element, arity, #name[0] == 'M'},
    WRLKIT_FIELD_TYPES(WRLKIT_X)
#undef WRLKIT_X
};

constexpr const FieldTypeInfo& info(FieldType t) { return field_type_infos[static_cast<std::size_t>(t)]; }
/// The type of that name ("MFVec3f"); false when there is none.
bool find_field_type(std::string_view name, FieldType& out);

/// One field of one node, or a default. `count` is the number of elements: 1 for SF types other than text, the bytes of
/// an SFString, the tuples of an MF type, the integers of an SFImage (width, height, components, pixels).
struct Value {
  static constexpr std::uint16_t extra_slot = 0xffff;  // a field that the node type does not have; see Scene::extra

  FieldType type = FieldType::verbatim;
  bool is = false;                  // `name IS other`: `chars` is the name of the PROTO's field
  std::uint16_t slot = extra_slot;  // index into NodeType::fields
  std::uint32_t count = 0;
  union {
    double number;          // SFFloat, SFDouble, SFTime
    std::int32_t integer;   // SFBool, SFInt32
    NodeId node;            // SFNode; Id::none is NULL
    const char* chars;      // SFString, SFEnum, SFBitMask, verbatim
    const double* numbers;  // every other type of numbers; count * arity of them
    const std::int32_t* integers;
    const std::string_view* texts;
    const NodeId* nodes;
    const struct ExtraField* extra;
  };

  constexpr Value() : number(0) {}

  std::string_view text() const { return {chars, count}; }
  std::span<const double> number_span() const;  // of any type of numbers, the inline ones included
  std::span<const std::int32_t> integer_span() const;
  std::span<const std::string_view> text_span() const { return {texts, count}; }
  std::span<const NodeId> node_span() const;  // SFNode too: empty when NULL
};

struct ExtraField {
  std::string_view name;
  Value value;
};

}  // namespace wrlkit
