// Escapes, encodings and units: each is in base/text once.
#include <catch2/catch.hpp>

#include "base/text/base64.h"
#include "base/text/csv.h"
#include "base/text/length_unit.h"
#include "base/text/xml_text.h"

using namespace wrlkit;

TEST_CASE("base64: what was encoded is read again", "[text]") {
  for (std::string_view bytes : {"", "f", "fo", "foo", "\xff\xfe\x00\x01", "foobar"})
    CHECK(base64_decode(base64(bytes)) == std::string(bytes));
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64_decode("Zm9v\n Yg") == "foob");  // RFC 2045 breaks lines; padding may be missing
  CHECK(base64_decode("-_-_") == base64_decode("+/+/"));
  CHECK_FALSE(base64_decode("Zm9*"));
}

TEST_CASE("csv: quotation marks where they are needed", "[text]") {
  CHECK(csv_text("pump 7") == "pump 7");
  CHECK(csv_text("a,b") == "\"a,b\"");
  CHECK(csv_text("2\" pipe") == "\"2\"\" pipe\"");
  CHECK(csv_quoted("x") == "\"x\"");
}

TEST_CASE("xml: text without markup", "[text]") {
  CHECK(xml_text("<a href=\"b\">&amp;\n\x01") == "&lt;a href=&quot;b&quot;&gt;&amp;amp;\n ");
}

TEST_CASE("lengths: units by their names", "[text]") {
  CHECK(metres_in("m") == 1.0);
  CHECK(metres_in("in") == 0.0254);
  CHECK_FALSE(metres_in("yd"));
  CHECK_FALSE(metres_in(""));
}
