// Mutations of worlds by the grammar, for the fuzzers that read them: fields, nodes, prototypes and ROUTEs of the node
// table come in (world_text.h), nodes go, are copied elsewhere, numbers become others. What is broken in a world stays
// broken, for nothing is parsed but braces or tags.
#pragma once
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "scenegraph/scene.h"
#include "tests/fuzz/world_text.h"

namespace wrlkit {

/// A node of a text.
struct NodePlace {
  const NodeType* type = nullptr;        // null: not in the table
  std::string name;                      // DEF
  std::size_t begin = 0, end = 0;        // with DEF and what closes it
  std::size_t attributes = 0, body = 0;  // where attributes and content may be put in
  bool is_closed_tag = false;            // <Box/>: there is no body yet
};

/// Nodes that are closed, in the order of their ends.
std::vector<NodePlace> nodes_in(std::string_view text, Dialect, Encoding);

/// The world with one to three changes; one of its own when there is none. `format`: of a text without a header.
std::string mutated_world(std::string text, Format format, std::mt19937&);

}  // namespace wrlkit

#ifdef WRLKIT_LIBFUZZER
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// What LLVMFuzzerCustomMutator does: changes by mutate(text, random), in turn with bytes that libFuzzer chooses.
template <class Mutate>
std::size_t mutate_in_turn(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed, Mutate mutate) {
  std::mt19937 random(seed);
  const bool bytes = random() % 3 == 0;
  if (!bytes) {
    const std::string text = mutate(std::string(reinterpret_cast<const char*>(data), size), random);
    if (text.size() <= max_size) {
      std::ranges::copy(text, data);
      return text.size();
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}
#endif
