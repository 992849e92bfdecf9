#include "base/text/backslash.h"

#include <catch2/catch.hpp>

using namespace wrlkit;

TEST_CASE("text in quotes") {
  CHECK(in_quotes("") == R"("")");
  CHECK(in_quotes("plain") == R"("plain")");
  CHECK(in_quotes(R"(a "b" c\)") == R"("a \"b\" c\\")");
  CHECK(in_quotes(R"("")") == R"("\"\"")");
}
