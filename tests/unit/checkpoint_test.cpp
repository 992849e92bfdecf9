// Tiles that were saved are found again, whatever happened to the end of the file.
#include "passes/lightmap/checkpoint.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "temp_folder.h"

using wrlkit::bake::Checkpoint;

TEST_CASE("checkpoint: a file that is something else is left as it is") {
  TempFolder folder;
  const auto path = (folder.path() / "scene.wrl").string();
  std::ofstream(path) << "#VRML";
  CHECK_THROWS_AS(Checkpoint(path, 7), std::runtime_error);
  Checkpoint::remove(path);
  CHECK(std::filesystem::file_size(path) == 5);
  std::filesystem::resize_file(path, 0);
  { Checkpoint empty(path, 7); }
  Checkpoint::remove(path);
  CHECK(!std::filesystem::exists(path));
}

TEST_CASE("checkpoint: tiles come back, those of other work do not") {
  TempFolder folder;
  const auto path = (folder.path() / "bake").string();
  {
    Checkpoint c(path, 7);
    c.save(3, {'a', 'b'});
    c.save(9, {});
  }
  {
    Checkpoint c(path, 7);
    CHECK(c.n_found() == 2);
    REQUIRE(c.find(3));
    CHECK(*c.find(3) == std::vector<char>{'a', 'b'});
    CHECK(c.find(9));
    CHECK(!c.find(4));
    c.save(4, {'c'});
  }
  CHECK(Checkpoint(path, 7).n_found() == 3);
  CHECK(Checkpoint(path, 8).n_found() == 0);
  CHECK(Checkpoint(path, 7).n_found() == 0);
}

TEST_CASE("checkpoint: a tail that was cut off or damaged is written again") {
  TempFolder folder;
  const auto path = (folder.path() / "bake").string();
  {
    Checkpoint c(path, 7);
    c.save(1, std::vector<char>(100, 'x'));
    c.save(2, std::vector<char>(100, 'y'));
  }
  const auto size = std::filesystem::file_size(path);
  SECTION("cut off") { std::filesystem::resize_file(path, size - 30); }
  SECTION("damaged") {
    std::fstream f(path, std::ios::in | std::ios::out | std::ios::binary);
    f.seekp(static_cast<std::streamoff>(size) - 5);
    f.put('z');
  }
  {
    Checkpoint c(path, 7);
    CHECK(c.n_found() == 1);
    CHECK(c.find(1));
    c.save(2, {'n'});
  }
  Checkpoint again(path, 7);
  CHECK(again.n_found() == 2);
  CHECK(*again.find(2) == std::vector<char>{'n'});
}

TEST_CASE("checkpoint: without a path nothing is kept; a path that cannot be written is an error") {
  Checkpoint none("", 1);
  none.save(1, {'a'});
  CHECK(!none.find(1));
  CHECK_THROWS(Checkpoint("/nonexistent/folder/file", 1));
}

TEST_CASE("checkpoint: what cannot be kept is known") {
  TempFolder folder;
  rlimit before;
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  Checkpoint c((folder.path() / "bake").string(), 7);
  c.save(1, std::vector<char>(100));
  CHECK(c.error() == 0);
  setrlimit(RLIMIT_FSIZE, &small);
  c.save(2, std::vector<char>(5000));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(c.error() == EFBIG);
}
