#include "src/study/ledger.h"

#include <fstream>

#include "tests/octree/las_fixture.h"

namespace stipple::test::study_ledger {
namespace {

class LedgerTest : public testing::Test {
 protected:
  std::string path() const { return folder_.path("finished.jsonl"); }
  void write_two() const {
    Ledger ledger(path(), settings_, false);
    ledger.put("a", {{"value", 1.0 / 3.0}});
    ledger.put("b", {{"value", 2}});
  }
  std::string error(const Json& settings) const {
    return error_of([&] { Ledger(path(), settings, true); });
  }

  const ScratchFolder folder_;
  const Json settings_{{"budget", 100}, {"modes", {"hybrid"}}};
};

TEST_F(LedgerTest, FindsWhatWasPutToTheLastBit) {
  write_two();
  const Ledger again(path(), settings_, true);
  EXPECT_EQ(again.find("a")->at("value"), 1.0 / 3.0);
  EXPECT_EQ(again.find("b")->at("value"), 2);
  EXPECT_EQ(again.find("c"), nullptr);
}

TEST_F(LedgerTest, BeginsAnewUnlessAskedToResume) {
  write_two();
  EXPECT_EQ(Ledger(path(), settings_, false).find("a"), nullptr);
  EXPECT_EQ(Ledger(path(), settings_, true).find("a"), nullptr);
}

TEST_F(LedgerTest, ResumingWhereNothingIsBegins) {
  Ledger ledger(path(), settings_, true);
  ledger.put("a", 1);
  EXPECT_NE(Ledger(path(), settings_, true).find("a"), nullptr);
}

TEST_F(LedgerTest, ALastLineCutShortCountsForNothing) {
  write_two();
  const auto size = std::filesystem::file_size(path());
  std::filesystem::resize_file(path(), size - 5);
  {
    Ledger again(path(), settings_, true);
    EXPECT_NE(again.find("a"), nullptr);
    EXPECT_EQ(again.find("b"), nullptr);
    again.put("c", 3);
  }
  const Ledger third(path(), settings_, true);
  EXPECT_NE(third.find("a"), nullptr);
  EXPECT_NE(third.find("c"), nullptr);
}

TEST_F(LedgerTest, OtherSettingsAreNamed) {
  write_two();
  const std::string message = error({{"budget", 200}, {"modes", {"hybrid"}}});
  for (const char* part : {"budget is 200, was 100", "--resume"}) EXPECT_TRUE(contains(message, part)) << message;
}

TEST_F(LedgerTest, WhatIsNoLedgerIsNamedWithItsLine) {
  std::ofstream(path()) << "budget=100\nand more\n";
  EXPECT_TRUE(contains(error(settings_), path() + ": line 1"));
  std::ofstream(path(), std::ios::trunc) << R"({"settings": {"budget": 100, "modes": ["hybrid"]}})"
                                         << "\n{\"value\": 3}\n\n";
  EXPECT_TRUE(contains(error(settings_), path() + ": line 2"));
}

}  // namespace
}  // namespace stipple::test::study_ledger
