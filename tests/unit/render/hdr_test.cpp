#include "render/hdr.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "render/error.h"

namespace lagomorph::render {
namespace hdr_test {

HdrPicture read(const std::string& bytes) {
  return read_hdr({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

std::string error_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const SettingsError& e) {
    return e.what();
  }
  return "none";
}

HdrPicture some_picture(int width, int height) {
  HdrPicture p{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const float x = static_cast<float>(i % 7);
    p.texels.emplace_back(i % 5 < 3 ? 0.25F : x, x * 100.0F, i == 3 ? 0.0F : 1e-4F);
  }
  return p;
}

TEST(Hdr, ReadsWhatItWrites) {
  for (const int width : {1, 7, 8, 300}) {  // the short ones are not run-length encoded
    const HdrPicture wrote = some_picture(width, 3);
    const HdrPicture got = read(write_hdr(wrote));
    ASSERT_EQ(got.width, width);
    ASSERT_EQ(got.height, 3);
    for (std::size_t i = 0; i < wrote.texels.size(); ++i) {
      // 8 bits of the largest of the three.
      const float step = wrote.texels[i].maxCoeff() / 128.0F;
      EXPECT_LE((got.texels[i] - wrote.texels[i]).abs().maxCoeff(), 0.51F * step) << width << " " << i;
    }
  }
  const HdrPicture black = read(write_hdr({1, 1, {Color::Zero()}}));
  EXPECT_EQ(black.texels[0].maxCoeff(), 0.0F);
}

const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

TEST(Hdr, ValuesAreMantissaTimesPowerOfTwo) {
  const std::string one = head + "\n-Y 1 +X 2\n" + std::string("\x80\x40\x20\x81\x80\x40\x20\x7e", 8);
  const HdrPicture p = read(one);
  EXPECT_EQ(p.texels[0].x(), 1.0F);
  EXPECT_EQ(p.texels[0].y(), 0.5F);
  EXPECT_EQ(p.texels[0].z(), 0.25F);
  EXPECT_EQ(p.texels[1].x(), 0.125F);
  const HdrPicture exposed =
      read(head + "EXPOSURE= 2\nEXPOSURE=4\n\n-Y 1 +X 1\n" + std::string("\x80\x40\x20\x81", 4));
  EXPECT_EQ(exposed.texels[0].x(), 0.125F);
}

TEST(Hdr, OldRunsRepeatTheTexelBefore) {
  const HdrPicture p =
      read(head + "\n-Y 1 +X 6\n" + std::string("\x80\x80\x80\x81\x01\x01\x01\x04\x80\x80\x80\x82", 12));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(p.texels[i].x(), 1.0F);
  EXPECT_EQ(p.texels[5].x(), 2.0F);
}

TEST(Hdr, DamageIsTold) {
  EXPECT_EQ(error_of(""), "is empty");
  EXPECT_NE(error_of("\x89PNG\n").find("is no Radiance picture"), std::string::npos);
  EXPECT_NE(error_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n").find("32-bit_rle_xyze"), std::string::npos);
  EXPECT_NE(error_of(head + "EXPOSURE=0\n\n").find("must be > 0"), std::string::npos);
  EXPECT_NE(error_of(head + "\n+Y 1 +X 1\n").find("'-Y height +X width' is read"), std::string::npos);
  EXPECT_NE(error_of(head + "\n-Y 99999 +X 99999\n").find("99999x99999"), std::string::npos);
  EXPECT_NE(error_of(head + "\n-Y 1 +X 0\n").find("0x1"), std::string::npos);
  const std::string whole = write_hdr(some_picture(40, 4));
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(error_of(whole.substr(0, n)), "none") << n;
  EXPECT_EQ(error_of(whole), "none");
  // A run that leaves its row.
  EXPECT_NE(
      error_of(head + "\n-Y 1 +X 8\n" + std::string("\x02\x02\x00\x08\x89\x01", 6)).find("out of its row"),
      std::string::npos);
  EXPECT_NE(error_of(head + "\n-Y 1 +X 8\n" + std::string("\x02\x02\x00\x09", 4)).find("another width"),
            std::string::npos);
}

}  // namespace hdr_test
}  // namespace lagomorph::render
