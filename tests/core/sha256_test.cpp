#include "core/sha256.h"

#include <gtest/gtest.h>

#include <string_view>

namespace plat {
namespace {

std::string digest_of(std::initializer_list<std::string_view> pieces) {
  Sha256 hash;
  for (const std::string_view piece : pieces) hash.add(std::as_bytes(std::span(piece)));
  return to_hex(hash.digest());
}

TEST(Sha256, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(digest_of({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of({"abc"}), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, DoesNotDependOnThePieces) {
  EXPECT_EQ(digest_of({"a", "", "bc"}), digest_of({"abc"}));
}

}  // namespace
}  // namespace plat
