#include "parsers/resources.h"

#include <sys/stat.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "base/image/image.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;
using namespace std::literals;
namespace fs = std::filesystem;

namespace {

using Urls = std::vector<std::string_view>;

/// A folder `world` with a file in it that refers to others, and a folder `other` next to it.
struct World {
  TempFolder folder;
  Diagnostics diag;
  std::string input = folder.write("world/plant.wrl", "#VRML V2.0 utf8\n");
  Span where{diag.sources().add(input, 16, nullptr), 1};
  int parsed = 0;
  std::vector<std::string> paths;
  FileResources resources{{.input = input}, [this](const std::string& path, Diagnostics&) { return parse(path); }};

  std::shared_ptr<const Scene> parse(const std::string& path) {
    ++parsed;
    paths.push_back(path);
    return std::make_shared<const Scene>();
  }

  std::string text(const Urls& urls) {
    auto blob = resources.bytes(urls, where, diag);
    return blob ? blob->bytes : "none";
  }
  /// The only message: its name and text.
  std::string message() const {
    if (diag.messages().size() != 1) return std::to_string(diag.messages().size()) + " messages";
    return info(diag.messages()[0].id).name + ": " + diag.messages()[0].text();
  }
};

std::string png(int width) {
  std::string error;
  return *encode_png({width, 1, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(width), 7)}, error);
}

}  // namespace

TEST_CASE("Urls are relative to the file that names them", "[resources]") {
  World w;
  w.folder.write("world/a.png", "beside");
  w.folder.write("world/parts/a.png", "beside the part");
  w.folder.write("world/maps/b.png", "below");
  CHECK(w.text({"a.png"}) == "beside");
  CHECK(w.text({"maps/b.png"}) == "below");
  CHECK(w.text({"./maps/../a.png"}) == "beside");
  CHECK(w.text({"file:a.png"}) == "beside");
  auto part = w.diag.sources().add(w.folder / "world/parts/part.wrl", 10, nullptr);
  auto blob = w.resources.bytes(Urls{"a.png"}, {part + 3, 1}, w.diag);
  REQUIRE(blob);
  CHECK(blob->bytes == "beside the part");
  CHECK(blob->name == "a.png");
  CHECK(w.resources.bytes(Urls{"../a.png"}, {part, 1}, w.diag)->bytes == "beside");
  // Nodes that passes have made, and standard input, belong to the input.
  CHECK(w.resources.bytes(Urls{"a.png"}, {}, w.diag)->bytes == "beside");
  auto piped = w.diag.sources().add("<stdin>", 10, nullptr);
  CHECK(w.resources.bytes(Urls{"a.png"}, {piped, 1}, w.diag)->bytes == "beside");
  CHECK(w.diag.messages().empty());
}

TEST_CASE("The first url that works is taken, silently", "[resources]") {
  World w;
  w.folder.write("world/b.png", "b");
  w.folder.write("world/c.png", "c");
  CHECK(w.text({"", "javascript: x", "http://example.org/a.png", "urn:a:b", "a.png", "b.png", "c.png"}) == "b");
  CHECK(w.diag.messages().empty());
}

TEST_CASE("When no url works, the first that is a file is told, once for a node", "[resources]") {
  World w;
  SECTION("missing") {
    CHECK(w.text({"http://example.org/a.png", "a.png", "b.png"}) == "none");
    CHECK(w.text({"http://example.org/a.png", "a.png", "b.png"}) == "none");
    CHECK(w.message() == "url-not-found: 'a.png' was not found");
    w.resources.bytes(Urls{"a.png"}, {w.where.begin + 5, 1}, w.diag);
    CHECK(w.diag.messages().size() == 2);
  }
  SECTION("elsewhere") {
    CHECK(w.text({"http://example.org/a.png", "urn:x:y"}) == "none");
    CHECK(w.message() ==
          "url-network: 'http://example.org/a.png' is not a local file; nothing is fetched from the network");
  }
  SECTION("nothing asked for") {
    CHECK(w.text({}) == "none");
    CHECK(w.text({"", " "}) == "none");
    CHECK(w.diag.messages().empty());
  }
  SECTION("a folder, a pipe, a name with a zero, a name without an end") {
    fs::create_directory(w.folder / "world/maps");
    REQUIRE(mkfifo((w.folder / "world/pipe").c_str(), 0600) == 0);
    const std::string endless(1 << 20, 'a'), steps = [] {
      std::string s;
      while (s.size() < 1 << 20) s += "../";
      return s;
    }();
    for (std::string_view url :
         {"maps"sv, "pipe"sv, "a%00b"sv, std::string_view(endless), std::string_view(steps), "."sv, "/"sv}) {
      CHECK(w.text({url}) == "none");
    }
    CHECK(w.diag.count(Diag::url_not_found) == 7);
  }
}

TEST_CASE("Nothing outside of the allowed folders is read", "[resources]") {
  World w;
  w.folder.write("other/secret.png", "secret");
  w.folder.write("world2/secret.png", "secret");
  SECTION("by going up") {
    CHECK(w.text({"../other/secret.png"}) == "none");
    CHECK(w.message() ==
          "url-outside: '../other/secret.png' is outside the folders that may be read; see --allow-path");
  }
  SECTION("in other ways") {
    const auto url = GENERATE("../../../../../../../../../../etc/passwd", "/etc/passwd", "file:///etc/passwd",
                              "%2e%2e/other/secret.png", "..\\other\\secret.png",
                              "../world2/secret.png");  // a folder whose name begins like the allowed one
    CHECK(w.text({url}) == "none");
    CHECK_THAT(w.message(), Catch::StartsWith("url-outside"));
  }
  SECTION("through a link to a file") {
    fs::create_symlink(w.folder / "other/secret.png", w.folder / "world/a.png");
    CHECK(w.text({"a.png"}) == "none");
    CHECK_THAT(w.message(), Catch::StartsWith("url-outside"));
  }
  SECTION("through a link to a folder") {
    fs::create_directory_symlink(w.folder / "other", w.folder / "world/maps");
    CHECK(w.text({"maps/secret.png"}) == "none");
    CHECK(w.text({"Maps/Secret.png"}) == "none");
    CHECK(w.diag.count(Diag::url_outside) == 2);
  }
  SECTION("by climbing out of a folder that a link leads to") {
    fs::create_directories(w.folder / "world/deep/er");
    fs::create_directory_symlink(w.folder / "world/deep/er", w.folder / "world/er");
    w.folder.write("world/deep/a.png", "inside");
    CHECK(w.text({"er/../a.png"}) == "inside");
    CHECK(w.text({"er/../../../other/secret.png"}) == "none");
    CHECK_THAT(w.message(), Catch::StartsWith("url-outside"));
  }
  SECTION("unless it is allowed") {
    FileResources allowed({.input = w.input, .allowed = {w.folder / "other"}}, {});
    CHECK(allowed.bytes(Urls{"../other/secret.png"}, w.where, w.diag)->bytes == "secret");
    auto absolute = w.folder / "other/secret.png";
    CHECK(allowed.bytes(Urls{absolute}, w.where, w.diag)->bytes == "secret");
    CHECK(w.diag.messages().empty());
  }
  SECTION("a link inside is fine") {
    w.folder.write("world/maps/a.png", "inside");
    fs::create_symlink("maps/a.png", w.folder / "world/link.png");
    CHECK(w.text({"link.png"}) == "inside");
  }
}

TEST_CASE("Paths of other systems are repaired, which is said", "[resources]") {
  World w;
  w.folder.write("world/Maps/Wood.PNG", "wood");
  w.folder.write("world/valve.wrl", "valve");
  auto found = w.folder / "world/Maps/Wood.PNG", valve = w.folder / "world/valve.wrl";
  SECTION("case") {
    CHECK(w.text({"maps/wood.png"}) == "wood");
    CHECK(w.message() ==
          "url-repaired: 'maps/wood.png' was not found; '" + found + "' next to the file is used instead");
  }
  SECTION("backslashes alone are no reason for a message") {
    CHECK(w.text({"Maps\\Wood.PNG"}) == "wood");
    CHECK(w.diag.messages().empty());
  }
  SECTION("a drive") {
    CHECK(w.text({"D:\\plant\\VALVE.WRL"}) == "valve");
    CHECK(w.message() ==
          "url-repaired: 'D:\\plant\\VALVE.WRL' was not found; '" + valve + "' next to the file is used instead");
  }
  SECTION("an absolute path") { CHECK(w.text({"/usr/people/me/valve.wrl"}) == "valve"); }
  SECTION("a path of the author's folders") { CHECK(w.text({"../../library/valve.wrl"}) == "valve"); }
  SECTION("a server") { CHECK(w.text({"\\\\server\\library\\valve.wrl"}) == "valve"); }
  SECTION("not to the file itself") {
    CHECK(w.text({"parts/plant.wrl"}) == "none");
    CHECK_THAT(w.message(), Catch::StartsWith("url-not-found"));
  }
  SECTION("the exact name goes before one of another case") {
    w.folder.write("world/valve.WRL", "other");
    CHECK(w.text({"valve.WRL"}) == "other");
    CHECK(w.text({"valve.wrl"}) == "valve");
    CHECK(w.text({"VALVE.wrl"}) == "other");  // the first in the order of bytes
  }
  SECTION("names that were never encoded") {
    w.folder.write("world/100%25#1.png", "literal");
    CHECK(w.text({"100%25#1.png"}) == "literal");
    CHECK(w.diag.messages().empty());
  }
  SECTION("encoded names") {
    w.folder.write("world/my maps/a#1.png", "encoded");
    CHECK(w.text({"my%20maps/a%231.png"}) == "encoded");
  }
}

TEST_CASE("Messages name files as the input was named", "[resources]") {
  TempFolder folder;
  folder.write("plant.wrl", "");
  folder.write("Part.wrl", "");
  auto before = fs::current_path();
  fs::current_path(folder.path());
  std::string path;
  FileResources resources({.input = "plant.wrl"}, [&](const std::string& p, Diagnostics&) {
    path = p;
    return std::make_shared<const Scene>();
  });
  Diagnostics diag;
  CHECK(resources.world(Urls{"part.wrl"}, {diag.sources().add("plant.wrl", 1, nullptr), 1}, diag).scene);
  fs::current_path(before);
  CHECK(path == "Part.wrl");
  CHECK(diag.messages()[0].text() == "'part.wrl' was not found; 'Part.wrl' next to the file is used instead");
}

TEST_CASE("A world is parsed once, however it is called", "[resources]") {
  World w;
  w.folder.write("world/parts/valve.wrl", "");
  auto first = w.resources.world(Urls{"parts/valve.wrl"}, w.where, w.diag).scene;
  REQUIRE(first);
  CHECK(w.resources.world(Urls{"parts/../parts/valve.wrl#Valve"}, w.where, w.diag).scene == first);
  CHECK(w.resources.world(Urls{"PARTS\\Valve.wrl"}, w.where, w.diag).scene == first);
  CHECK(w.parsed == 1);
  CHECK(w.paths[0] == w.folder / "world/parts/valve.wrl");
  CHECK_FALSE(w.resources.world(Urls{"data:model/vrml,Shape{}"}, w.where, w.diag).scene);
}

TEST_CASE("A world that cannot be parsed is tried once, and the next url after it", "[resources]") {
  World w;
  w.folder.write("world/bad.wrl", "");
  w.folder.write("world/good.wrl", "");
  int tried = 0;
  FileResources resources({.input = w.input},
                          [&](const std::string& path, Diagnostics& diag) -> std::shared_ptr<const Scene> {
                            ++tried;
                            if (path.ends_with("good.wrl")) return std::make_shared<const Scene>();
                            diag.report(Diag::empty_file, {});
                            return nullptr;
                          });
  CHECK_FALSE(resources.world(Urls{"bad.wrl"}, w.where, w.diag).scene);
  CHECK_FALSE(resources.world(Urls{"bad.wrl"}, w.where, w.diag).scene);
  CHECK(w.message() == "empty-file: the file is empty");
  CHECK(tried == 1);
  CHECK(resources.world(Urls{"bad.wrl", "good.wrl"}, w.where, w.diag).scene);
}

TEST_CASE("A world that asks for itself while it is parsed is a cycle", "[resources]") {
  World w;
  w.folder.write("world/a.wrl", "");
  FileResources* self = nullptr;
  FileResources resources({.input = w.input}, [&](const std::string&, Diagnostics& diag) {
    CHECK_FALSE(self->world(Urls{"a.wrl"}, w.where, diag).scene);
    return std::make_shared<const Scene>();
  });
  self = &resources;
  CHECK(resources.world(Urls{"a.wrl"}, w.where, w.diag).scene);
  CHECK(w.message() == "url-cycle: 'a.wrl' contains itself");
}

TEST_CASE("Pictures", "[resources]") {
  World w;
  w.folder.write("world/a.png", png(3));
  w.folder.write("world/bad.png", "\x89PNG\r\n\x1a\nnot really");
  w.folder.write("world/b.jpg", "#VRML V2.0 utf8");
  SECTION("are decoded once") {
    auto image = w.resources.image(Urls{"a.png"}, w.where, w.diag);
    REQUIRE(image);
    CHECK(image->width == 3);
    CHECK(image->pixels == std::vector<std::uint8_t>{7, 7, 7});
    CHECK(w.resources.image(Urls{"A.png"}, w.where, w.diag) == image);
    CHECK(w.resources.bytes(Urls{"a.png"}, w.where, w.diag)->mime == "image/png");
  }
  SECTION("say why they cannot be read, each node once") {
    CHECK_FALSE(w.resources.image(Urls{"bad.png"}, w.where, w.diag));
    CHECK_FALSE(w.resources.image(Urls{"bad.png"}, w.where, w.diag));
    CHECK(w.message() == "image-unreadable: picture 'bad.png' cannot be read: its data are damaged");
    CHECK_FALSE(w.resources.image(Urls{"b.jpg"}, w.where, w.diag));
    CHECK(w.diag.messages()[1].text() == "picture 'b.jpg' cannot be read: it is no picture of a known type");
  }
  SECTION("or give way to the next one") {
    CHECK(w.resources.image(Urls{"bad.png", "a.png"}, w.where, w.diag));
    CHECK(w.diag.messages().empty());
  }
  SECTION("in the url") {
    auto image = w.resources.image(
        Urls{"data:image/"
             "png;base64,"
             "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=="},
        w.where, w.diag);
    REQUIRE(image);
    CHECK(image->channels == 4);
    CHECK_FALSE(w.resources.image(Urls{"data:image/png;base64,!"}, w.where, w.diag));
    CHECK(w.message() ==
          "image-unreadable: picture 'data:image/png;base64,!' cannot be read: the data in the url are damaged");
  }
  SECTION("that are too large are not read") {
    FileResources small({.input = w.input, .max_bytes = 10}, {});
    CHECK_FALSE(small.bytes(Urls{"a.png"}, w.where, w.diag));
    CHECK(w.message() == "image-unreadable: picture 'a.png' cannot be read: it is larger than 10 bytes");
  }
}

TEST_CASE("What is in use stays the same object; what is not may be dropped", "[resources]") {
  World w;
  w.folder.write("world/a.bin", std::string(600, 'a'));
  w.folder.write("world/b.bin", std::string(600, 'b'));
  FileResources resources({.input = w.input, .cached_bytes = 1000}, {});
  auto a = resources.bytes(Urls{"a.bin"}, w.where, w.diag);
  std::weak_ptr<const Blob> b = resources.bytes(Urls{"b.bin"}, w.where, w.diag);
  CHECK_FALSE(b.expired());
  CHECK(resources.bytes(Urls{"a.bin"}, w.where, w.diag) == a);
  w.folder.write("world/c.bin", std::string(600, 'c'));
  resources.bytes(Urls{"c.bin"}, w.where, w.diag);
  CHECK(b.expired());
  CHECK(resources.bytes(Urls{"b.bin"}, w.where, w.diag)->bytes == std::string(600, 'b'));
  CHECK(resources.bytes(Urls{"a.bin"}, w.where, w.diag) == a);
}

TEST_CASE("Several threads get the same objects", "[resources]") {
  World w;
  for (int i = 0; i < 8; ++i) w.folder.write("world/" + std::to_string(i) + ".png", png(i + 1));
  std::array<std::array<std::shared_ptr<const Image>, 8>, 4> got;
  {
    std::vector<std::jthread> threads;
    for (auto& mine : got)
      threads.emplace_back([&] {
        Diagnostics diag(w.diag.shared_sources());
        for (std::size_t i = 0; i < 8; ++i) {
          auto url = std::to_string(i) + ".png";
          mine[i] = w.resources.image(Urls{url}, w.where, diag);
        }
      });
  }
  for (std::size_t i = 0; i < 8; ++i) {
    REQUIRE(got[0][i]);
    CHECK(got[0][i]->width == static_cast<int>(i) + 1);
    for (auto& other : got) CHECK(other[i] == got[0][i]);
  }
}
