#include "src/study/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace stipple::test::study_progress {
namespace {

class StudyProgressTest : public testing::Test {
 protected:
  StudyProgress progress(std::size_t curves, const std::atomic<bool>* flag = nullptr) {
    return StudyProgress([this](const std::string& line) { lines_.push_back(line); }, curves, flag);
  }
  std::vector<std::string> lines_;
};

TEST_F(StudyProgressTest, CountsAndTellsTheTimeLeftOnceItKnows) {
  StudyProgress counted = progress(4);
  counted.begin_curve("a");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  counted.end_curve();
  counted.begin_curve("b");
  EXPECT_EQ(lines_[0], "[1/4] a");
  EXPECT_EQ(lines_[1], "[2/4] b, about 1 s left");
}

TEST_F(StudyProgressTest, WhatIsLeftOutTakesNoTime) {
  StudyProgress counted = progress(4);
  counted.leave_out(2);
  counted.begin_curve("a");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  counted.end_curve();
  counted.begin_curve("b");
  EXPECT_EQ(lines_[0], "[3/4] a");
  EXPECT_EQ(lines_[1], "[4/4] b, about 1 s left");
}

TEST_F(StudyProgressTest, EndsAtTheNextStepOnceTheFlagIsUp) {
  std::atomic<bool> flag{false};
  StudyProgress counted = progress(4, &flag);
  counted.begin_curve("a");
  EXPECT_NO_THROW(counted.check());
  flag = true;
  EXPECT_THROW(counted.check(), Interrupted);
  EXPECT_THROW(counted.begin_curve("b"), Interrupted);
  EXPECT_THROW(counted.step("c"), Interrupted);
  EXPECT_EQ(lines_.size(), 1u);
}

}  // namespace
}  // namespace stipple::test::study_progress
