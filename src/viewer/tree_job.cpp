#include "src/viewer/tree_job.h"

#include <exception>
#include <utility>

#include "octree/build/stream/tree_builder.h"
#include "octree/open/open.h"
#include "src/viewer/window.h"

namespace stipple {

TreeJob::~TreeJob() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void TreeJob::start(const std::vector<std::string>& inputs, const std::string& folder, std::uint64_t memory) {
  folder_ = folder;
  watch_ = {};
  cancelled_ = false;
  monitor_.emplace();
  thread_ = std::thread([this, inputs, memory] { work(inputs, memory); });
}

void TreeJob::work(const std::vector<std::string>& inputs, std::uint64_t memory) {
  Result result{.folder = folder_, .failure = {}};
  try {
    const auto sources = open_each(inputs);
    build_tree(sources, folder_, {.memory = memory}, *monitor_);
  } catch (const std::bad_alloc&) {
    result.failure = "there is too little memory to build the octree";
  } catch (const std::exception& e) {
    result.failure = e.what();
  }
  {
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
  }
  Window::wake();
}

TreeJob::Status TreeJob::status() const {
  return {folder_, monitor_->progress(), watch_.seconds()};
}

void TreeJob::cancel() {
  if (!monitor_) return;
  cancelled_ = true;
  monitor_->stop();
}

std::optional<TreeJob::Result> TreeJob::take() {
  std::optional<Result> result;
  {
    const std::lock_guard lock(mutex_);
    result = std::exchange(result_, std::nullopt);
  }
  if (!result) return result;
  thread_.join();
  monitor_.reset();
  result->cancelled = cancelled_ && !result->failure.empty();
  return result;
}

}  // namespace stipple
