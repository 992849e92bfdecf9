#include "base/text/json.h"

#include <catch2/catch.hpp>
#include <map>
#include <vector>

using namespace wrlkit;

namespace {

enum class State : std::uint8_t { good, bad };
std::string_view to_string(State s) { return s == State::good ? "good" : "bad"; }

struct Point {
  double x = 0;
  void fields(auto&& f) const { f("x", x); }
};

struct Report {
  std::string name;
  State state = State::good;
  std::optional<double> seconds;
  std::vector<Point> points;
  std::map<std::string, int> counts;
  void fields(auto&& f) const {
    f("name", name);
    f("state", state);
    f("seconds", seconds);
    f("points", points);
    f("counts", counts);
    f("more", JsonText{"[null]"});
  }
};

}  // namespace

TEST_CASE("json of structs that describe themselves") {
  CHECK(json_of(Report{}) == R"({"name":"","state":"good","points":[],"counts":{},"more":[null]})");
  const Report r{"a\"b", State::bad, 0.5, {{1}, {2}}, {{"k", 1}, {"l", 2}}};
  CHECK(
      json_of(r) ==
      R"({"name":"a\"b","state":"bad","seconds":0.5,"points":[{"x":1},{"x":2}],"counts":{"k":1,"l":2},"more":[null]})");
  CHECK(json_of(std::vector<std::string>{"a", "b"}) == R"(["a","b"])");
}

TEST_CASE("json of members in turn") {
  CHECK(json_of(json_object("a", 1, "none", std::optional<int>(), "b", json_object("c", "d"))) ==
        R"({"a":1,"b":{"c":"d"}})");
  const std::vector<int> numbers{1, 2};
  CHECK(json_text([&](JsonOut& json) {
          json.object([&] {
            json.members("x", 1, "y", true);
            json.list("all", numbers, [&](int n) { json.object("n", n); });
            json.object("inner", [&] { json.member("raw", JsonText{"[null]"}); });
            json.list("none", std::vector<int>(), [&](int n) { json.value(n); });
          });
        }) == R"({"x":1,"y":true,"all":[{"n":1},{"n":2}],"inner":{"raw":[null]},"none":[]})");
}
