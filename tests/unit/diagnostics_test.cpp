// Messages: what is counted, and what is kept.
#include <catch2/catch.hpp>

#include <string>

#include "base/diagnostics.h"
#include "base/text/utf8.h"

using namespace wrlkit;

TEST_CASE("diagnostics: the same message of the same place counts once, beyond those that are kept, too",
          "[diagnostics]") {
  Diagnostics diag;
  for (int twice = 0; twice < 2; ++twice)
    for (std::uint32_t place = 0; place < 5; ++place) diag.report(Diag::undefined_use, Span{place, 1}, "A");
  CHECK(diag.count(Diag::undefined_use) == 5);
  diag.report(Diag::undefined_use, Span{4, 1}, "B");
  diag.report(Diag::undefined_use, Span{}, "A");
  diag.report(Diag::undefined_use, Span{}, "A");
  CHECK(diag.count(Diag::undefined_use) == 8);
  CHECK(diag.messages().size() == Diagnostics::kept_per_name);
}

TEST_CASE("diagnostics: long arguments are cut between characters", "[diagnostics]") {
  for (std::size_t before = 0; before < 4; ++before) {
    std::string name(before, 'a');
    for (int i = 0; i < 100; ++i) name += "ü";
    Diagnostics diag;
    diag.report(Diag::undefined_use, {}, name);
    const auto& said = diag.messages()[0].args[0];
    CHECK(is_utf8(said));
    CHECK(said.ends_with("ü..."));
  }
}
