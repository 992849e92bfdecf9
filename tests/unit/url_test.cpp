#include "base/io/url.h"

#include <catch2/catch.hpp>

using namespace wrlkit;
using namespace std::string_literals;

namespace {

std::string first_path(std::string_view url) { return url_paths(url)[0]; }

}  // namespace

TEST_CASE("Kinds of urls", "[url]") {
  CHECK(url_kind("a.png") == UrlKind::file);
  CHECK(url_kind("  maps/a.png ") == UrlKind::file);
  CHECK(url_kind("C:\\maps\\a.png") == UrlKind::file);
  CHECK(url_kind("FILE:///a.png") == UrlKind::file);
  CHECK(url_kind("") == UrlKind::file);
  CHECK(url_kind(":a") == UrlKind::file);
  CHECK(url_kind("a b:c") == UrlKind::file);
  CHECK(url_kind("data:image/png;base64,AAAA") == UrlKind::data);
  CHECK(url_kind("javascript: function f() {}") == UrlKind::script);
  CHECK(url_kind("vrmlscript:x") == UrlKind::script);
  CHECK(url_kind("http://example.org/a.png") == UrlKind::remote);
  CHECK(url_kind("HTTPS://example.org/a.png") == UrlKind::remote);
  CHECK(url_kind("ftp://example.org/a.png") == UrlKind::remote);
  CHECK(url_kind("urn:inet:blaxxun.com:node:ViewBox") == UrlKind::remote);
}

TEST_CASE("The path in a url", "[url]") {
  CHECK(first_path("a.wrl") == "a.wrl");
  CHECK(first_path("protos.wrl#Valve") == "protos.wrl");
  CHECK(first_path("a.wrl?x=1#y") == "a.wrl");
  CHECK(first_path("my%20maps/a%2Bb.png") == "my maps/a+b.png");
  CHECK(first_path("100%.png") == "100%.png");
  CHECK(first_path("50%zz") == "50%zz");
  CHECK(first_path("a%") == "a%");
  CHECK(first_path("maps\\wood.png") == "maps/wood.png");
  CHECK(first_path("..\\maps\\wood.png") == "../maps/wood.png");
  CHECK(first_path("C:\\maps\\wood.png") == "C:/maps/wood.png");
  CHECK(first_path("d|/maps/wood.png") == "d:/maps/wood.png");
  CHECK(first_path("\\\\server\\maps\\wood.png") == "//server/maps/wood.png");
  CHECK(first_path("file:///home/me/a.png") == "/home/me/a.png");
  CHECK(first_path("file://localhost/home/a.png") == "/home/a.png");
  CHECK(first_path("file:/home/a.png") == "/home/a.png");
  CHECK(first_path("file:a.png") == "a.png");
  CHECK(first_path("file:///C:/maps/a.png") == "C:/maps/a.png");
  CHECK(first_path("file:///C|/maps/a.png") == "C:/maps/a.png");
  CHECK(first_path("file://C:\\maps\\a.png") == "C:/maps/a.png");
  CHECK(first_path("file:\\\\\\C:\\maps\\a.png") == "C:/maps/a.png");
  CHECK(first_path("file://server/maps/a.png") == "//server/maps/a.png");
}

TEST_CASE("Further paths: names that were never encoded", "[url]") {
  CHECK(url_paths("a.png") == std::vector<std::string>{"a.png"});
  CHECK(url_paths("a%20b.png") == std::vector<std::string>{"a b.png", "a%20b.png"});
  CHECK(url_paths("no#1.png") == std::vector<std::string>{"no", "no#1.png"});
  CHECK(url_paths("maps\\a.png") == std::vector<std::string>{"maps/a.png", "maps\\a.png"});
}

TEST_CASE("Data urls", "[url]") {
  CHECK(decode_data_url("data:image/png;base64,iVBORw0KGgo=") == "\x89PNG\r\n\x1a\n"s);
  CHECK(decode_data_url("data:;base64,YQ") == "a");
  CHECK(decode_data_url("data:;base64,YWI=") == "ab");
  CHECK(decode_data_url("data:;base64,YW\n Jj") == "abc");
  CHECK(decode_data_url("data:;base64,%59%57%4Ajj%2B-_%2f").has_value());
  CHECK(decode_data_url("data:;base64,-_-_") == decode_data_url("data:;base64,+/+/"));
  CHECK(decode_data_url("data:text/plain,a%20b%00c") == "a b\0c"s);
  CHECK(decode_data_url("data:,") == "");
  CHECK_FALSE(decode_data_url("data:;base64,Y*=="));
  CHECK_FALSE(decode_data_url("data:image/png;base64"));
}

TEST_CASE("Drives", "[url]") {
  CHECK(has_drive("C:/x"));
  CHECK(has_drive("c:\\x"));
  CHECK(has_drive("c:"));
  CHECK_FALSE(has_drive("/c:/x"));
  CHECK_FALSE(has_drive("cc:/x"));
  CHECK_FALSE(has_drive("c:x"));
  CHECK_FALSE(has_drive(""));
}
