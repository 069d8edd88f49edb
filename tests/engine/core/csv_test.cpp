#include "engine/core/csv.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace burnish {
namespace {

TEST(Csv, CellsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(csvRow({"time", "force x", ""}), "time,force x,");
  EXPECT_EQ(csvRow({"a,b", "say \"no\"", "two\nlines"}), "\"a,b\",\"say \"\"no\"\"\",\"two\nlines\"");
  EXPECT_EQ(csvRow({}), "");
}

TEST(Csv, CellsOfARowAreThoseThatWereWritten) {
  using Cells = std::vector<std::string>;
  for (const Cells& cells : {Cells{"time", "force x", ""}, Cells{"a,b", "say \"no\"", "c"}, Cells{""}})
    EXPECT_EQ(cellsOfRow(csvRow(cells)), cells);
  EXPECT_EQ(cellsOfRow("\"a\", \"b, c\" ,d e"), (Cells{"a", "b, c", "d e"}));
  EXPECT_EQ(cellsOfRow("\"a,b"), (Cells{"\"a", "b"})) << "quotes that are not closed are letters";
  EXPECT_EQ(cellsOfRow("\"a\"b,c"), (Cells{"\"a\"b", "c"}));
}

}  // namespace
}  // namespace burnish
