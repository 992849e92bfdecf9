// What Scripts may use, all of a world together.
#pragma once
#include <cstddef>
#include <cstdint>

namespace wrlkit {

inline constexpr unsigned script_seconds = 2;                      // of processor time
inline constexpr std::size_t script_memory = 64 << 20;             // of the engine
inline constexpr std::size_t script_process_bytes = 320ull << 20;  // of address space: engine, frames and the program
inline constexpr int script_wait_seconds = 20;                     // by the clock, on a machine that does other things
inline constexpr std::size_t script_requests = 1'000'000;          // questions of Scripts
inline constexpr std::size_t script_exchanged = 128 << 20;         // bytes of questions and answers
inline constexpr std::size_t script_events = 100'000;              // that are sent
inline constexpr std::size_t script_made_text = 4 << 20;           // bytes of all texts for createVrmlFromString
inline constexpr std::size_t script_made_texts = 10'000;           // of these texts
inline constexpr std::size_t script_made_nodes = 200'000;
inline constexpr std::size_t script_depth = 1000;  // of nested nodes, as parsers allow

}  // namespace wrlkit
