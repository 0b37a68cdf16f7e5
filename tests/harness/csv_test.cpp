#include "harness/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plat::harness {
namespace {

TEST(CsvTable, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(CsvTable::quoted("plain text"), "plain text");
  EXPECT_EQ(CsvTable::quoted("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvTable::quoted("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(CsvTable::quoted("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(CsvTable::quoted("carriage\rreturn"), "\"carriage\rreturn\"");
  EXPECT_EQ(CsvTable::quoted(""), "");
}

TEST(CsvTable, WritesOneLinePerRowAndNothingForAnAbsentValue) {
  CsvTable table("a,b,c,d");
  table.add_row("x,y", 3, std::optional<double>(), 0.5);
  table.add_row(std::string("z"), std::uint64_t{18446744073709551615ULL}, std::optional(2.0), -1.0);
  EXPECT_EQ(table.text(), "a,b,c,d\n\"x,y\",3,,0.5\nz,18446744073709551615,2,-1\n");
}

TEST(CsvTable, NumbersReadBackExactly) {
  for (const double number :
       {0.1, 1.0 / 3.0, 1e-300, 123456789.12345678, std::nextafter(1.0, 2.0)}) {
    CsvTable table("n");
    table.add_row(number);
    const std::string text = table.text().substr(2);
    EXPECT_EQ(std::stod(text), number) << text;
  }
}

TEST(CsvTable, AnEmptyLastFieldKeepsItsComma) {
  CsvTable table("a,b");
  table.add_row(1, std::optional<int>());
  EXPECT_EQ(table.text(), "a,b\n1,\n");
}

}  // namespace
}  // namespace plat::harness
