#pragma once
#include <string>

/// Says that a test, of the tag [found], is left out for something that is not there; the program then ends with 77, by
/// which CTest knows a skipped test.
void skip(const std::string& why);
