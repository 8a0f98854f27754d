// Tells the thread sanitizer what Debian's libtbb, which is not built with it, orders in time: a task runs after
// it was spawned, a wait ends after the tasks it waited for. Without this every parallel_for looks like a race; with it
// a race between two tasks, or between a task and who waits for it, is still found. Linked into builds with
// -fsanitize=thread only: these functions stand before libtbb's of the same name and call them.
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>
#include <tbb/task_arena.h>

#include <cstdlib>

namespace tbb::detail::r1 {
namespace {

using d1::delegate_base;
using d1::execution_data;
using d1::slot_id;
using d1::small_object_pool;
using d1::task;
using d1::task_arena_base;
using d1::task_group_context;
using d1::wait_context;

// libtbb's own function. Signatures of the mangled names below are those of the functions that use them.
template <typename Function>
Function* next(const char* mangled) {
  void* const address = dlsym(RTLD_NEXT, mangled);
  if (!address) std::abort();
  return reinterpret_cast<Function*>(address);
}

// Stands in the scheduler's queue for the task it was spawned as.
class OrderedTask final : public task {
 public:
  explicit OrderedTask(task& inner) : inner_(inner) { __tsan_release(this); }

  task* execute(execution_data& data) override {
    __tsan_acquire(this);
    task* const next_task = inner_.execute(data);  // when it throws, cancel() comes next
    delete this;
    return next_task;
  }
  task* cancel(execution_data& data) override {
    __tsan_acquire(this);
    task* const next_task = inner_.cancel(data);
    delete this;
    return next_task;
  }

 private:
  task& inner_;
};

// task_arena::execute() may hand its work to another thread.
class OrderedWork final : public delegate_base {
 public:
  explicit OrderedWork(delegate_base& inner) : inner_(inner) { __tsan_release(this); }
  bool operator()() const override {
    void* const self = const_cast<OrderedWork*>(this);
    __tsan_acquire(self);
    const bool result = inner_();
    __tsan_release(self);
    return result;
  }

 private:
  delegate_base& inner_;
};

}  // namespace

void spawn(task& t, task_group_context& context) {
  static auto* const real =
      next<void(task&, task_group_context&)>("_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  real(*new OrderedTask(t), context);
}

void spawn(task& t, task_group_context& context, slot_id slot) {
  static auto* const real = next<void(task&, task_group_context&, slot_id)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  real(*new OrderedTask(t), context, slot);
}

// The last task of a wait says so here.
void notify_waiters(std::uintptr_t wait_address) {
  static auto* const real = next<void(std::uintptr_t)>("_ZN3tbb6detail2r114notify_waitersEm");
  __tsan_release(reinterpret_cast<void*>(wait_address));
  real(wait_address);
}

void execute_and_wait(task& t, task_group_context& task_context, wait_context& waited, task_group_context& context) {
  static auto* const real = next<void(task&, task_group_context&, wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
  real(t, task_context, waited, context);
  __tsan_acquire(&waited);
}

void wait(wait_context& waited, task_group_context& context) {
  static auto* const real = next<void(wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
  real(waited, context);
  __tsan_acquire(&waited);
}

void execute(task_arena_base& arena, delegate_base& work) {
  static auto* const real = next<void(task_arena_base&, delegate_base&)>(
      "_ZN3tbb6detail2r17executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE");
  OrderedWork ordered(work);
  real(arena, ordered);
  __tsan_acquire(&ordered);
}

// libtbb's pool hands memory from thread to thread unseen; malloc's does so in sight.
void* allocate(small_object_pool*& pool, std::size_t bytes) {
  static char no_pool;
  pool = reinterpret_cast<small_object_pool*>(&no_pool);
  return ::operator new (bytes, std::align_val_t{d1::task_alignment});
}

void* allocate(small_object_pool*& pool, std::size_t bytes, const execution_data&) {
  return allocate(pool, bytes);
}

void deallocate(small_object_pool&, void* object, std::size_t) {
  ::operator delete (object, std::align_val_t{d1::task_alignment});
}

void deallocate(small_object_pool& pool, void* object, std::size_t bytes, const execution_data&) {
  deallocate(pool, object, bytes);
}

}  // namespace tbb::detail::r1
