// Messages: what is counted, and what is kept.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"

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
