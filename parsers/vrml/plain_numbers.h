// Lists of numbers as nearly every program writes them: digits, at most a sign and a point, blanks between. These are
// most of the bytes of most files, and are read without a branch for each digit.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

namespace wrlkit::vrml {

/// Appends the numbers from `p` up to the first that is not written plainly, and returns where that begins; never
/// behind `end`, and some bytes before it, because bytes are read ahead. Exact, as read_double and read_int32 are.
const char* read_plain_numbers(const char* p, const char* end, std::vector<double>& to);
const char* read_plain_numbers(const char* p, const char* end, std::vector<std::int32_t>& to);

/// The numbers of a whole list in place of those that were there. False when there is anything but numbers and blanks,
/// or a number that has to be repaired. `end`: up to where bytes may be read, for what follows a list makes it faster.
bool read_plain_list(std::string_view list, const char* end, std::vector<double>& to);
bool read_plain_list(std::string_view list, const char* end, std::vector<std::int32_t>& to);

}  // namespace wrlkit::vrml
