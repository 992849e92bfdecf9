// Values of fields as JSON, for the process of Scripts: numbers, texts, and flat arrays of them; nodes by their
// numbers.
#pragma once
#include <optional>
#include <string>

#include "base/text/json.h"
#include "base/text/json_reader.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Whether a Script can hold values of that type.
bool is_script_type(FieldType);
void write_value(JsonOut&, const Value&);
std::string value_text(const Value&);
/// A value for a slot. None when it is not of that type: numbers that are missing, not finite or too large, nodes that
/// do not exist.
std::optional<Value> read_value(Scene&, FieldType, std::uint16_t slot, Json);

}  // namespace wrlkit
