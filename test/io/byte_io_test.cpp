#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/byte_reader.h"
#include "io/byte_writer.h"
#include "io/error_text.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

TEST(ByteIo, LittleEndianAndUnpadded) {
  ByteWriter writer;
  writer.u8(0xFE);
  writer.u32(0x01020304);
  writer.u64(0x1122334455667788);
  writer.f32(1.0F);
  writer.f64(-2.0);
  writer.raw("ab");
  EXPECT_EQ(
      writer.take(),
      std::string("\xFE\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11\x00\x00\x80\x3F\x00\x00\x00\x00\x00"
                  "\x00\x00\xC0"
                  "ab",
                  27));
  EXPECT_EQ(writer.take(), "") << "what was taken is gone";
}

TEST(ByteIo, RoundTripToTheBit) {
  ByteWriter writer;
  writer.u8(255);
  writer.u32(0xFFFFFFFF);
  writer.u64(0x8000000000000001);
  writer.f32(std::numeric_limits<float>::denorm_min());
  writer.f64(-0.0);
  writer.f64(std::numeric_limits<double>::quiet_NaN());
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  EXPECT_EQ(reader.u8(), 255);
  EXPECT_EQ(reader.u32(), 0xFFFFFFFFU);
  EXPECT_EQ(reader.u64(), 0x8000000000000001U);
  EXPECT_EQ(reader.f32(), std::numeric_limits<float>::denorm_min());
  EXPECT_TRUE(std::signbit(reader.f64()));
  EXPECT_TRUE(std::isnan(reader.f64()));
  EXPECT_TRUE(reader.rest().empty());
}

TEST(ByteIo, NothingIsReadBeyondTheEnd) {
  for (std::size_t n = 0; n < 8; ++n) {
    const std::string bytes(n, '\1');
    EXPECT_THROW((void)ByteReader(bytes).u64(), InputError);
    EXPECT_THROW((void)ByteReader(bytes).f64(), InputError);
    if (n < 4) {
      EXPECT_THROW((void)ByteReader(bytes).u32(), InputError);
      EXPECT_THROW((void)ByteReader(bytes).f32(), InputError);
      EXPECT_THROW((void)ByteReader(bytes).count(1), InputError);
    }
  }
  EXPECT_THROW((void)ByteReader("").u8(), InputError);
}

TEST(ByteIo, CountsThatTheRestCannotHoldAreRefused) {
  const std::string three_of_two("\3\0\0\0abcdef", 10);
  EXPECT_EQ(ByteReader(three_of_two).count(2), 3U);
  EXPECT_THAT(input_error([&] { (void)ByteReader(three_of_two).count(3); }), HasSubstr("promises more"));
  const std::string huge("\xFF\xFF\xFF\xFF", 4);
  EXPECT_THROW((void)ByteReader(huge).count(1), InputError);
}

}  // namespace
}  // namespace cpslam
