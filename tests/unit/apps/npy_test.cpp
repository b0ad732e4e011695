#include "apps/npy.h"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "tests/support/run_tree.h"

namespace lagomorph::apps {
namespace npy_test {

using Shape = std::vector<std::size_t>;

std::string error_of(const std::string& bytes) {
  try {
    read_npy(bytes, "a.npy");
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    return error.what();
  }
  return "no error";
}

/// A file of format 1.0 with this header.
std::string with_header(const std::string& header, const std::string& values) {
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + values;
}

const std::vector<double> numbers = {1.0, -2.5, 1e300, 4.0, 0.1, -0.0};

TEST(Npy, IsWhatNumpyWrites) {
  // numpy.save of numpy.array([[1., -2.5]]), byte by byte.
  std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
  expected += "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }";
  expected.append(127 - expected.size(), ' ');
  expected += '\n';
  expected += std::string("\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\x04\xC0", 16);
  EXPECT_EQ(npy_bytes(std::span(numbers).first(2), Shape{1, 2}), expected);
}

TEST(Npy, FloatsHaveFourBytes) {
  const std::array<float, 2> values = {1.0F, -2.5F};
  const std::string bytes = npy_bytes(values, Shape{2});
  EXPECT_EQ(bytes.size(), 128U + 8U);
  EXPECT_NE(bytes.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }"), std::string::npos);
  EXPECT_EQ(bytes.substr(128), std::string("\0\0\x80\x3F\0\0\x20\xC0", 8));
}

TEST(Npy, HeadersOfAnyLengthAreAligned) {
  for (std::size_t n = 1; n < 2000000000; n = n * 7 + 1) {
    const std::string bytes = npy_bytes(std::span<const double>(), Shape{0, n, n, n});
    EXPECT_EQ(bytes.size() % 64, 0U) << n;
    EXPECT_EQ(bytes.back(), '\n');
    EXPECT_EQ(read_npy(bytes, "a").shape, (Shape{0, n, n, n}));
  }
}

TEST(Npy, ReadsWhatItWrites) {
  for (const Shape& shape : {Shape{6}, Shape{2, 3}, Shape{1, 2, 1, 3}}) {
    const NpyArray array = read_npy(npy_bytes(numbers, shape), "a");
    EXPECT_EQ(array.shape, shape);
    EXPECT_EQ(array.values, numbers);
  }
}

TEST(Npy, ReadsWhatNumpyWrote) {
  const NpyArray array =
      read_npy(read_file(tests::data_file("truth/4_bar_dynamic/be_dt60_snh_positions.npy")), "a");
  ASSERT_EQ(array.shape.size(), 3U);
  EXPECT_EQ(array.shape[2], 3U);
  EXPECT_EQ(array.values.size(), array.shape[0] * array.shape[1] * array.shape[2]);
  for (const double value : array.values) EXPECT_LT(std::abs(value), 10.0);  // a bar of a metre
}

TEST(Npy, ReadsOtherSpacingOrderAndFormats) {
  const std::string values(16, '\0');
  EXPECT_EQ(read_npy(with_header("{'shape':(2,),'fortran_order':False,'descr':'<f8'}\n", values), "a").shape,
            Shape{2});
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n";
  std::string second("\x93NUMPY\x02\x00", 8);
  second += static_cast<char>(header.size());
  second.append(3, '\0');
  second += header + values;
  EXPECT_EQ(read_npy(second, "a").shape, Shape{2});
}

TEST(Npy, TellsWhatIsWrong) {
  const std::string good = npy_bytes(numbers, Shape{2, 3});
  EXPECT_EQ(error_of(""), "a.npy: is no npy file: it must begin with \\x93NUMPY");
  EXPECT_EQ(error_of("P6 4 4"), "a.npy: is no npy file: it must begin with \\x93NUMPY");
  for (const std::size_t size : {7U, 9U, 40U}) {
    EXPECT_EQ(error_of(good.substr(0, size)), "a.npy: is truncated inside the npy header") << size;
  }
  EXPECT_EQ(error_of(good.substr(0, good.size() - 1)),
            "a.npy: has 47 bytes of values, which is not what the shape (2, 3) of float64 needs");
  EXPECT_EQ(error_of(good + "x"),
            "a.npy: has 49 bytes of values, which is not what the shape (2, 3) of float64 needs");
  std::string other = good;
  other[6] = '\x07';
  EXPECT_EQ(error_of(other), "a.npy: has npy format 7; 1, 2 or 3 would be right");
  EXPECT_EQ(error_of(with_header("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }", "1234")),
            "a.npy: has values of type '<f4'; '<f8' would be right");
  EXPECT_EQ(error_of(with_header("{'descr': '<f8', 'fortran_order': True, 'shape': (1,), }", "12345678")),
            "a.npy: is in Fortran order; C order would be right");
  for (const char* header : {"", "{}", "{'descr': '<f8', 'fortran_order': False, 'shape': (1,", "{'descr'",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': 1, }"}) {
    EXPECT_EQ(error_of(with_header(header, "12345678")), "a.npy: has an npy header that cannot be read")
        << header;
  }
  EXPECT_EQ(
      error_of(
          with_header("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967297), }", "")),
      "a.npy: has 0 bytes of values, which is not what the shape (4294967296, 4294967297) of float64 needs");
}

TEST(Npy, ShapesAreTuples) {
  EXPECT_EQ(shape_text(Shape{}), "()");
  EXPECT_EQ(shape_text(Shape{3}), "(3,)");
  EXPECT_EQ(shape_text(Shape{1, 2, 27, 3}), "(1, 2, 27, 3)");
}

}  // namespace npy_test
}  // namespace lagomorph::apps
