#include "base/io/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "base/io/read_file.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;
namespace fs = std::filesystem;

namespace {

mode_t mode_of(const std::string& path) {
  struct stat s {};
  REQUIRE(stat(path.c_str(), &s) == 0);
  return s.st_mode & 07777;
}

/// The only message, which must be cannot-write.
std::string only_message(const Diagnostics& diag) {
  REQUIRE(diag.messages().size() == 1);
  CHECK(diag.messages()[0].id == Diag::cannot_write);
  return diag.messages()[0].text();
}

bool write_file(const std::string& path, std::string_view bytes, Diagnostics& diag, OutputOptions options = {}) {
  auto out = OutputFile::open(path, options, diag);
  if (!out) return false;
  out->write(bytes);
  return out->commit(diag);
}

/// Standard output into a file while it lives.
class Captured {
 public:
  explicit Captured(const std::string& path) : kept_(dup(1)) {
    int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(fd, 1);
    close(fd);
  }
  ~Captured() {
    dup2(kept_, 1);
    close(kept_);
  }

 private:
  int kept_;
};

}  // namespace

TEST_CASE("A file appears when it is committed, whole and alone", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  auto out = OutputFile::open(folder / "a.glb", {}, diag);
  REQUIRE(out);
  out->write("one ");
  const std::string big(300'000, 'x');
  const std::vector<std::string_view> pieces{"two ", "", big, " three"};
  out->write(pieces);
  CHECK_FALSE(fs::exists(folder / "a.glb"));
  CHECK(out->commit(diag));
  CHECK(folder.read("a.glb") == "one two " + big + " three");
  CHECK(folder.file_count() == 1);
  CHECK(diag.messages().empty());
}

TEST_CASE("Thousands of pieces are written in order", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  std::vector<std::string> texts;
  std::string all;
  for (int i = 0; i < 3000; ++i)
    all += texts.emplace_back(static_cast<std::size_t>(i % 700), static_cast<char>('a' + i % 26));
  const std::vector<std::string_view> pieces(texts.begin(), texts.end());
  auto out = OutputFile::open(folder / "a", {}, diag);
  out->write(pieces);
  CHECK(out->commit(diag));
  CHECK(folder.read("a") == all);
}

TEST_CASE("An empty file is a file", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  CHECK(write_file(folder / "empty", "", diag));
  CHECK(fs::file_size(folder / "empty") == 0);
}

TEST_CASE("What is not committed leaves no trace, and the old file", "[output]") {
  TempFolder folder;
  folder.write("a.wrl", "old");
  Diagnostics diag;
  {
    auto out = OutputFile::open(folder / "a.wrl", {}, diag);
    out->write(std::string(1 << 20, 'n'));
  }
  CHECK(folder.read("a.wrl") == "old");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("A file is replaced with its permissions; a new one has those of the umask", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  folder.write("a.wrl", "old and longer");
  chmod((folder / "a.wrl").c_str(), 0640);
  CHECK(write_file(folder / "a.wrl", "new", diag));
  CHECK(folder.read("a.wrl") == "new");
  CHECK(mode_of(folder / "a.wrl") == 0640);
  auto old = umask(027);
  CHECK(write_file(folder / "b.wrl", "new", diag));
  umask(old);
  CHECK(mode_of(folder / "b.wrl") == 0640);
  CHECK(folder.file_count() == 2);
}

TEST_CASE("A symbolic link stays a link", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  folder.write("real/a.wrl", "old");
  fs::create_symlink(folder / "real/a.wrl", folder / "link.wrl");
  CHECK(write_file(folder / "link.wrl", "new", diag));
  CHECK(fs::is_symlink(folder / "link.wrl"));
  CHECK(folder.read("real/a.wrl") == "new");
}

TEST_CASE("Folders are made, and stay with what is written only", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  {
    auto file = OutputFile::open(folder / "new/below/a.glb", {}, diag);
    REQUIRE(file);
    file->write("given up");
  }
  CHECK_FALSE(fs::exists(folder / "new"));
  auto file = OutputFile::open(folder / "new/below/a.glb", {}, diag);
  REQUIRE(file);
  file->write("whole");
  CHECK(file->commit(diag));
  CHECK(folder.read("new/below/a.glb") == "whole");
}

TEST_CASE("Where nothing can be written, that is said at once", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  SECTION("below a file") {
    folder.write("none", "");
    CHECK_FALSE(OutputFile::open(folder / "none/a.glb", {}, diag));
    CHECK(only_message(diag) ==
          "cannot write '" + (folder / "none/a.glb") + "': '" + (folder / "none") + "' is not a folder");
  }
  SECTION("a directory") {
    CHECK_FALSE(OutputFile::open(folder.path().string(), {}, diag));
    CHECK_THAT(only_message(diag), Catch::EndsWith("it is a directory"));
  }
  SECTION("the name of a directory") {
    CHECK_FALSE(OutputFile::open(folder / "new/", {}, diag));
    CHECK_THAT(only_message(diag), Catch::EndsWith("it is a directory"));
  }
  SECTION("a file as folder") {
    folder.write("a", "");
    CHECK_FALSE(OutputFile::open(folder / "a/b.glb", {}, diag));
    CHECK_THAT(only_message(diag), Catch::EndsWith("is not a folder"));
  }
  SECTION("no name") {
    CHECK_FALSE(OutputFile::open("", {}, diag));
    CHECK_THAT(only_message(diag), Catch::Contains("cannot write ''"));
  }
  SECTION("no permission") {
    folder.write("a.glb", "old");
    chmod((folder / "a.glb").c_str(), 0444);
    chmod(folder.path().c_str(), 0555);
    bool may = geteuid() == 0;  // root may write anywhere
    CHECK(OutputFile::open(folder / "a.glb", {}, diag).has_value() == may);
    CHECK(OutputFile::open(folder / "b.glb", {}, diag).has_value() == may);
    CHECK(diag.count(Diag::cannot_write) == (may ? 0u : 2u));
    chmod(folder.path().c_str(), 0755);
  }
}

TEST_CASE("A full disk is reported once, by commit", "[output]") {
  Diagnostics diag;
  auto out = OutputFile::open("/dev/full", {}, diag);
  REQUIRE(out);
  for (int i = 0; i < 5; ++i) out->write(std::string(100'000, 'x'));
  CHECK_FALSE(out->commit(diag));
  CHECK(only_message(diag) == "cannot write '/dev/full': there is no space left");
}

TEST_CASE("A file in the way of the target is found out at commit, and nothing stays", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  auto out = OutputFile::open(folder / "a", {}, diag);
  out->write("x");
  fs::create_directory(folder / "a");
  CHECK_FALSE(out->commit(diag));
  CHECK_THAT(only_message(diag), Catch::EndsWith("it is a directory"));
  CHECK(folder.file_count() == 1);
  CHECK(fs::is_directory(folder / "a"));
}

TEST_CASE("Devices and pipes are written directly", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  CHECK(write_file("/dev/null", "gone", diag));
  CHECK(fs::is_character_file("/dev/null"));
  auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string got;
  std::jthread reader([&] { got = folder.read("pipe"); });
  CHECK(write_file(pipe, "through", diag));
  reader.join();
  CHECK(got == "through");
  CHECK(diag.messages().empty());
}

TEST_CASE("Standard output gets everything at commit, or nothing", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  const std::string big(3'000'000, 'b');
  {
    Captured captured(folder / "out");
    auto dropped = OutputFile::open("-", {}, diag);
    dropped->write(big);
    dropped.reset();
    auto out = OutputFile::open("-", {}, diag);
    out->write("a");
    out->write(big);
    CHECK(out->commit(diag));
  }
  CHECK(folder.read("out") == "a" + big);
}

TEST_CASE("A head is written over when the sizes in it are known", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  const auto write = [&](const std::string& path, const std::string& body) {
    auto out = OutputFile::open(path, {}, diag);
    REQUIRE(out);
    CHECK(out->can_rewrite());
    out->write("head");
    out->write(body);
    out->rewrite(0, "HEAD");
    out->write(" and more");
    CHECK(out->commit(diag));
  };
  const std::string big(3'000'000, 'b');
  for (const auto& body : {std::string("small"), big}) {
    write(folder / "a.glb", body);
    CHECK(folder.read("a.glb") == "HEAD" + body + " and more");
  }
  {
    Captured captured(folder / "out");
    write("-", big);
  }
  CHECK(folder.read("out") == "HEAD" + big + " and more");
  CHECK_FALSE(OutputFile::open(folder / "a.wrz", {.gzip = true}, diag)->can_rewrite());
  CHECK_FALSE(OutputFile::open("/dev/null", {}, diag)->can_rewrite());
  CHECK(diag.messages().empty());
}

TEST_CASE("gzip: the same bytes each time, without a date, and they unpack to what was written", "[output]") {
  TempFolder folder;
  Diagnostics diag;
  std::string text = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 200'000; ++i) text += std::to_string(i * 7 % 1000) + (i % 9 ? " " : "\n");
  CHECK(write_file(folder / "a.wrz", text, diag, {.gzip = true}));
  auto out = OutputFile::open(folder / "b.wrz", {.gzip = true}, diag);
  for (std::size_t at = 0; at < text.size(); at += 777) out->write(std::string_view(text).substr(at, 777));
  CHECK(out->commit(diag));
  auto packed = folder.read("a.wrz");
  CHECK(packed == folder.read("b.wrz"));
  CHECK(packed.substr(0, 10) == std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10));
  CHECK(packed.size() < text.size() / 2);
  auto back = read_file(folder / "a.wrz", {}, diag);
  REQUIRE(back);
  CHECK(back->gzip);
  CHECK(back->view() == text);
  CHECK(write_file(folder / "empty.gz", "", diag, {.gzip = true}));
  CHECK(fs::file_size(folder / "empty.gz") == 20);
  CHECK(diag.messages().empty());
}
