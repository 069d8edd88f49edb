#include "engine/core/csv.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(Csv, CellsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(csvRow({"time", "force x", ""}), "time,force x,");
  EXPECT_EQ(csvRow({"a,b", "say \"no\"", "two\nlines"}), "\"a,b\",\"say \"\"no\"\"\",\"two\nlines\"");
  EXPECT_EQ(csvRow({}), "");
}

}  // namespace
}  // namespace burnish
