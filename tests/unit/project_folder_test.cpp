#include "base/io/project_folder.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "base/io/linked_file.h"
#include "parsers/resources.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;
using namespace std::literals;
namespace fs = std::filesystem;

namespace {

/// a/b/c/d below a temporary folder, which no one else may write to.
struct Project {
  TempFolder folder;
  std::string input = folder.write("a/b/c/d/plant.wrl", "#VRML V2.0 utf8\n");
  std::string of(const std::string& name) { return project_folder(folder / name); }
  std::string real(const std::string& name) { return fs::canonical(folder / name).string(); }
};

/// HOME for as long as this lives.
struct Home {
  std::string before = std::getenv("HOME") ? std::getenv("HOME") : "";
  explicit Home(const std::string& folder) { setenv("HOME", folder.c_str(), 1); }
  ~Home() { setenv("HOME", before.c_str(), 1); }
};

constexpr auto gif = "GIF89a\1\0\1\0\0\0\0"sv;

}  // namespace

TEST_CASE("A project reaches two levels up", "[project folder]") {
  Project p;
  CHECK(p.of("a/b/c/d") == p.real("a/b"));
  CHECK(project_folder("/no/such/folder").empty());
  CHECK(project_folder("/") == "/");
  SECTION("or as far as version control says") {
    fs::create_directory(p.folder / "a/.git");
    CHECK(p.of("a/b/c/d") == p.real("a"));
    fs::create_directory(p.folder / "a/b/c/CVS");
    CHECK(p.of("a/b/c/d") == p.real("a/b/c"));
    fs::create_directory(p.folder / "a/b/c/d/.hg");
    CHECK(p.of("a/b/c/d") == p.real("a/b/c/d"));
  }
  SECTION("but not the home, nor above it") {
    Home home(p.folder / "a/b/c");
    CHECK(p.of("a/b/c/d") == p.real("a/b/c/d"));
    CHECK(p.of("a/b/c") == p.real("a/b/c"));
    CHECK(p.of("a/b") == p.real("a/b"));
  }
  SECTION("nor where everybody may write") {
    fs::permissions(p.folder / "a/b/c", fs::perms::all);
    CHECK(p.of("a/b/c/d") == p.real("a/b/c/d"));
  }
  SECTION("and from where a link leads to") {
    fs::create_directory_symlink(p.folder / "a/b/c/d", p.folder / "short");
    CHECK(p.of("short") == p.real("a/b"));
  }
}

TEST_CASE("Files that worlds refer to are known by their first bytes", "[project folder]") {
  TempFolder folder;
  const auto is_linked = [&](const char* name, std::string_view bytes) {
    return is_linked_kind(folder.write(name, std::string(bytes)));
  };
  CHECK(is_linked("a", gif));
  CHECK(is_linked("a", "RIFF\4\0\0\0WAVEfmt "sv));
  CHECK(is_linked("a", "\0\0\1\xba"sv));
  CHECK(is_linked("a.txt", "#VRML V1.0 ascii\n"));
  CHECK(is_linked("a", "\xef\xbb\xbf#X3D V3.0 utf8\n"));
  CHECK(is_linked("a", "<?xml version='1.0'?>\n<X3D>"));
  CHECK(is_linked("a.wrl", "\x1f\x8b\x08"));
  CHECK_FALSE(is_linked("a.tar", "\x1f\x8b\x08"));
  CHECK_FALSE(is_linked("a.wrl", ""));
  CHECK_FALSE(is_linked("a.wrl", "root:x:0:0:root:/root:/bin/bash\n"));
  CHECK_FALSE(is_linked("a.png", "-----BEGIN OPENSSH PRIVATE KEY-----\n"));
  CHECK_FALSE(is_linked("a.x3d", "<?xml version='1.0'?><passwords/>"));
  CHECK_FALSE(is_linked_kind(folder / "missing.png"));
}

TEST_CASE("Linked files of the project are found above the input", "[project folder]") {
  Project p;
  for (auto name : {"a/b/c/one.gif", "a/b/two.gif", "a/three.gif", "a/b/maps/four.gif"})
    p.folder.write(name, std::string(gif));
  p.folder.write("a/b/key.gif", "secret");
  fs::create_symlink(p.folder / "a/three.gif", p.folder / "a/b/link.gif");
  Diagnostics diag;
  const Span where{diag.sources().add(p.input, 16, nullptr), 1};
  FileResources resources({.input = p.input, .project = true}, {});
  const auto reads = [&](std::string_view url) { return resources.bytes({{url}}, where, diag) != nullptr; };
  CHECK(reads("../one.gif"));
  CHECK(reads("../../two.gif"));
  CHECK(reads("../../MAPS/Four.gif"));
  CHECK(reads("file://" + p.folder / "a/b/two.gif"));
  CHECK(resources.files_above() == 3);
  CHECK(diag.count(Diag::url_outside) == 0);
  CHECK_FALSE(reads("../../../three.gif"));
  CHECK_FALSE(reads("../../key.gif"));
  CHECK_FALSE(reads("../../link.gif"));
  CHECK_FALSE(reads("/etc/passwd"));
  CHECK(diag.count(Diag::url_outside) == 4);
  CHECK(resources.files_above() == 3);
}
