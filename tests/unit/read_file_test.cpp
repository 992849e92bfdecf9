#include "base/io/read_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <thread>

#include "base/io/output.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;
using namespace std::string_literals;
namespace fs = std::filesystem;

namespace {

std::string gzip(std::string_view text) {
  TempFolder folder;
  Diagnostics diag;
  auto out = OutputFile::open(folder / "a", {.gzip = true}, diag);
  out->write(text);
  out->commit(diag);
  return folder.read("a");
}

std::string numbers() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i * 7919 % 100'003) + '\n';
  return text;
}

/// The only message, which must have that name.
std::string only_message(const Diagnostics& diag, Diag id) {
  REQUIRE(diag.messages().size() == 1);
  CHECK(info(diag.messages()[0].id).name == info(id).name);
  return diag.messages()[0].text();
}

std::string_view file_of_message(const Diagnostics& diag) {
  auto place = diag.sources().locate(diag.messages()[0].where);
  CHECK(place.line == 0);
  return place.file;
}

/// Standard input from a file while it lives.
class Fed {
 public:
  explicit Fed(const std::string& path) : kept_(dup(0)) { REQUIRE(freopen(path.c_str(), "r", stdin)); }
  ~Fed() {
    dup2(kept_, 0);
    close(kept_);
  }

 private:
  int kept_;
};

}  // namespace

TEST_CASE("A file is read whole", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  for (std::size_t size : {1u, 65535u, 65536u, 65537u, 3'000'000u}) {
    std::string text;
    while (text.size() < size) text += std::to_string(text.size()) + ' ';
    text.resize(size);
    auto file = read_file(folder.write("a.wrl", text), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK(file->name == folder / "a.wrl");
    CHECK(file->bytes_on_disk == size);
    CHECK_FALSE(file->gzip);
  }
  CHECK(diag.messages().empty());
}

TEST_CASE("Messages find the text again, zipped or not", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  auto first = read_file(folder.write("a.wrl", "one\ntwo three\n"), {}, diag);
  auto second = read_file(folder.write("b.wrl", gzip("#VRML\nShape { }\n")), {}, diag);
  REQUIRE((first && second));
  CHECK(first->base == 0);
  auto place = diag.sources().locate({second->base + 6, 5});
  CHECK(place.file == folder / "b.wrl");
  CHECK(place.line == 2);
  CHECK(place.column == 1);
  CHECK(place.line_text == "Shape { }");
  CHECK(diag.sources().locate({first->base + 8, 5}).column == 5);
  CHECK(diag.sources().locate({first->base + 8, 5}).line_text == "two three");
}

TEST_CASE("What cannot be read says why", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  SECTION("missing") {
    CHECK_FALSE(read_file(folder / "no.wrl", {}, diag));
    CHECK(only_message(diag, Diag::cannot_read) == "cannot read '" + (folder / "no.wrl") + "': there is no such file");
  }
  SECTION("a directory") {
    CHECK_FALSE(read_file(folder.path().string(), {}, diag));
    CHECK_THAT(only_message(diag, Diag::cannot_read), Catch::EndsWith("': it is a directory"));
  }
  SECTION("a name with a zero in it") {
    folder.write("a", "x");
    CHECK_FALSE(read_file((folder / "a") + "\0b"s, {}, diag));
    CHECK_THAT(only_message(diag, Diag::cannot_read), Catch::EndsWith("there is no such file"));
  }
  SECTION("no permission") {
    auto path = folder.write("a.wrl", "x");
    chmod(path.c_str(), 0);
    if (geteuid() == 0) return;  // root may read everything
    CHECK_FALSE(read_file(path, {}, diag));
    CHECK_THAT(only_message(diag, Diag::cannot_read), Catch::EndsWith("permission denied"));
  }
  SECTION("empty") {
    CHECK_FALSE(read_file(folder.write("a.wrl", ""), {}, diag));
    CHECK(only_message(diag, Diag::empty_file) == "the file is empty");
    CHECK(file_of_message(diag) == folder / "a.wrl");
  }
  SECTION("gzip data of nothing") {
    CHECK_FALSE(read_file(folder.write("a.wrl", gzip("")), {}, diag));
    only_message(diag, Diag::empty_file);
  }
  SECTION("nothing, from a device") {
    CHECK_FALSE(read_file("/dev/null", {}, diag));
    only_message(diag, Diag::empty_file);
  }
}

TEST_CASE("Limits", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  SECTION("ten gigabytes of nothing are not read") {
    auto path = folder.write("a.wrl", "");
    REQUIRE(truncate(path.c_str(), off_t{10} << 30) == 0);
    CHECK_FALSE(read_file(path, {}, diag));
    CHECK(only_message(diag, Diag::too_large) == "the file exceeds the limit of 4 GiB (10 GiB)");
    CHECK(file_of_message(diag) == path);
  }
  SECTION("a file of the limit, and one byte more") {
    auto path = folder.write("a.wrl", std::string(100'000, 'x'));
    CHECK(read_file(path, {.max_bytes = 100'000}, diag));
    CHECK(diag.messages().empty());
    CHECK_FALSE(read_file(path, {.max_bytes = 99'999}, diag));
    only_message(diag, Diag::too_large);
  }
  SECTION("a device without an end") {
    CHECK_FALSE(read_file("/dev/zero", {.max_device = 1 << 20}, diag));
    CHECK(only_message(diag, Diag::too_large) == "the file exceeds the limit of 1 MiB (it does not end)");
  }
}

TEST_CASE("Files whose size is not known beforehand", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  SECTION("a file of the system that says it has 0 bytes") {
    auto file = read_file("/proc/self/status", {}, diag);
    REQUIRE(file);
    CHECK(file->view().find("VmPeak") != std::string_view::npos);
  }
  SECTION("a pipe, whose text is kept for messages") {
    auto pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const auto text = numbers();
    std::jthread writer([&] { std::ofstream(pipe, std::ios::binary) << text; });
    auto file = read_file(pipe, {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK(diag.sources().locate({file->base + 2, 1}).line == 2);
  }
  SECTION("standard input, zipped") {
    const auto text = numbers();
    Fed fed(folder.write("a", gzip(text)));
    auto file = read_file("-", {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK(file->name == "<stdin>");
    CHECK(file->gzip);
    CHECK(diag.sources().locate({file->base + 2, 1}).file == "<stdin>");
    CHECK(diag.sources().locate({file->base + 2, 1}).line == 2);
  }
}

TEST_CASE("gzip by magic bytes", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  const auto text = numbers(), packed = gzip(text);
  SECTION("under any name") {
    auto file = read_file(folder.write("a.wrl", packed), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK(file->gzip);
    CHECK(file->bytes_on_disk == packed.size());
    CHECK(diag.messages().empty());
  }
  SECTION("the name alone does not make it gzip") {
    auto file = read_file(folder.write("a.wrl.gz", "#VRML V2.0 utf8"), {}, diag);
    REQUIRE(file);
    CHECK_FALSE(file->gzip);
    CHECK(file->view() == "#VRML V2.0 utf8");
  }
  SECTION("several members, and padding") {
    auto file = read_file(folder.write("a.wrl", packed + gzip("and more") + std::string(1000, '\0')), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text + "and more"));
    CHECK(diag.messages().empty());
  }
}

TEST_CASE("damaged gzip", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  const auto text = numbers(), packed = gzip(text);
  SECTION("cut off") {
    auto file = read_file(folder.write("a.wrl", packed.substr(0, packed.size() / 2)), {}, diag);
    REQUIRE(file);
    CHECK(only_message(diag, Diag::gzip_damaged) ==
          "the gzip data is damaged (it ends too early); only what could be unpacked is used");
    CHECK(file_of_message(diag) == folder / "a.wrl");
    CHECK(file->view().size() > text.size() / 3);
    CHECK(text.starts_with(file->view()));
  }
  SECTION("cut off before anything could be unpacked") {
    CHECK_FALSE(read_file(folder.write("a.wrl", packed.substr(0, 8)), {}, diag));
    only_message(diag, Diag::gzip_damaged);
  }
  SECTION("wrong in the middle") {
    auto bad = packed;
    for (std::size_t i = bad.size() / 2; i < bad.size() / 2 + 50; ++i) bad[i] = '\xff';
    auto file = read_file(folder.write("a.wrl", bad), {}, diag);
    REQUIRE(file);
    only_message(diag, Diag::gzip_damaged);
    CHECK(file->view().substr(0, text.size() / 3) == text.substr(0, text.size() / 3));
  }
  SECTION("a wrong sum") {
    auto bad = packed;
    bad[bad.size() - 6] ^= 1;
    auto file = read_file(folder.write("a.wrl", bad), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK_THAT(only_message(diag, Diag::gzip_damaged), Catch::Contains("incorrect data check"));
  }
  SECTION("something else behind it") {
    auto file = read_file(folder.write("a.wrl", packed + "<html>"), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    CHECK_THAT(only_message(diag, Diag::gzip_damaged), Catch::Contains("something else follows it"));
  }
  SECTION("a length that it does not have") {
    auto bad = packed;
    bad[bad.size() - 1] = '\x7f';  // two gigabytes
    auto file = read_file(folder.write("a.wrl", bad), {}, diag);
    REQUIRE(file);
    CHECK((file->view() == text));
    only_message(diag, Diag::gzip_damaged);
  }
  SECTION("magic bytes and nothing else") {
    CHECK_FALSE(read_file(folder.write("a.wrl", "\x1f\x8b"), {}, diag));
    only_message(diag, Diag::gzip_damaged);
  }
}

TEST_CASE("gzip bombs", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  const auto bomb = gzip(std::string(100 << 20, ' '));
  CHECK(bomb.size() < 200'000);
  SECTION("are stopped by their ratio") {
    auto file = read_file(folder.write("a.wrl", bomb), {}, diag);
    REQUIRE(file);
    CHECK(only_message(diag, Diag::gzip_bomb) ==
          "the gzip data unpacks to more than 200 times its size; the rest is dropped");
    CHECK(file->view().size() > 64u << 20);
    CHECK(file->view().size() <= 80u << 20);
  }
  SECTION("by their size") {
    auto file = read_file(folder.write("a.wrl", bomb), {.max_unpacked = 1 << 20}, diag);
    REQUIRE(file);
    CHECK(only_message(diag, Diag::gzip_bomb) == "the gzip data unpacks to more than 1 MiB; the rest is dropped");
    CHECK(file->view().size() == 1u << 20);
  }
  SECTION("small ones are no bombs") {
    auto file = read_file(folder.write("a.wrl", gzip(std::string(60 << 20, ' '))), {}, diag);
    REQUIRE(file);
    CHECK(file->view().size() == 60u << 20);
    CHECK(diag.messages().empty());
  }
}

TEST_CASE("Texts that are too many for one run are refused", "[read_file]") {
  TempFolder folder;
  Diagnostics diag;
  diag.sources().add("big", std::size_t{0xffffffff} - 100, nullptr);
  CHECK_FALSE(read_file(folder.write("a.wrl", std::string(200, 'x')), {}, diag));
  CHECK(only_message(diag, Diag::too_large) == "the file exceeds the limit of 4 GiB (all files together)");
}

TEST_CASE("Bytes of regular files only", "[read_file]") {
  TempFolder folder;
  std::string why;
  CHECK(read_bytes(folder.write("a.bin", "\0\1\2"s), 3, why).value() == "\0\1\2"s);
  CHECK_FALSE(read_bytes(folder / "a.bin", 2, why));
  CHECK(why == "it is larger than 2 bytes");
  CHECK_FALSE(read_bytes(folder / "none", 2, why));
  CHECK(why == "there is no such file");
  auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(read_bytes(pipe, 2, why));
  CHECK(why == "it is no regular file");
}

TEST_CASE("Sizes are readable", "[read_file]") {
  CHECK(readable_size(0) == "0 bytes");
  CHECK(readable_size(1500) == "1500 bytes");
  CHECK(readable_size(64 << 20) == "64 MiB");
  CHECK(readable_size(5504 << 10) == "5.4 MiB");
  CHECK(readable_size(ReadLimits::one_text) == "4 GiB");
  CHECK(readable_size(std::uint64_t{10} << 30) == "10 GiB");
}
