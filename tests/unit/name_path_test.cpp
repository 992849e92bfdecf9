// Names on the way to a part, as one text.
#include "scenegraph/places/name_path.h"

#include <catch2/catch.hpp>

using namespace wrlkit;

TEST_CASE("a name is the same behind its way through a path", "[names]") {
  for (const std::string name :
       {"Pump", "12/P-101", "/", "//", "100%", "%2F", "%25", "%252F", "%2", "a%/b", "%%2F/25", ""})
    CHECK(name_of_step(path_step(name)) == name);
}

TEST_CASE("only what would be read otherwise is changed in a path", "[names]") {
  CHECK(path_below("", "Pump") == "Pump");
  CHECK(path_below("Unit", "12/P-101") == "Unit/12%2FP-101");
  CHECK(path_step("100% steel") == "100% steel");
  CHECK(path_step("a%2Fb") == "a%252Fb");
}

TEST_CASE("a path has the steps that it was made of", "[names]") {
  CHECK(path_steps("Unit/12%2FP-101") == std::vector<std::string_view>{"Unit", "12%2FP-101"});
  CHECK(path_steps("a//b") == std::vector<std::string_view>{"a", "", "b"});
  CHECK(path_steps("") == std::vector<std::string_view>{""});
}
