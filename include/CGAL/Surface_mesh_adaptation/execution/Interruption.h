// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a run is stopped while a kernel, or what comes before and after the kernels, is at work.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_INTERRUPTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_INTERRUPTION_H

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Thrown out of a parallel step when a run is to stop and there is nothing yet that is worth keeping.
struct Interrupted
{};

/// Asks whether a run is to go on, about every twentieth of a second, while its tasks run: on the thread that began it,
/// which takes part in these.
class Interruption
{
public:
  /// What a request to stop does: nothing; kernels look for it, and leave out what they have not begun; or what runs is
  /// given up.
  enum class Effect { none, leave_out, give_up };

  explicit Interruption(std::function<bool()> go_on) : go_on_(std::move(go_on)), owner_(std::this_thread::get_id()) {}

  /// To be called before each task. \throws Interrupted if what runs is to be given up
  void poll()
  {
    if (effect_ == Effect::none) return;
    if (std::this_thread::get_id() == owner_) ask();
    if (effect_ == Effect::give_up && is_requested()) throw Interrupted();
  }

  bool is_requested() const { return is_requested_.load(std::memory_order_relaxed); }

  Effect effect() const { return effect_; }
  /// \pre no task runs
  void set_effect(Effect effect) { effect_ = effect; }

private:
  using Clock = std::chrono::steady_clock;

  void ask()
  {
    constexpr std::chrono::milliseconds period(50);
    if (is_requested() || Clock::now() - last_ < period) return;
    if (!go_on_()) is_requested_.store(true, std::memory_order_relaxed);
    last_ = Clock::now();
  }

  std::function<bool()> go_on_;
  std::thread::id owner_;
  Clock::time_point last_ = Clock::now();
  std::atomic<bool> is_requested_{false};
  Effect effect_ = Effect::give_up;
};

/// Lets requests to stop have another effect while it lives.
class Effect_of_interruption
{
public:
  Effect_of_interruption(Interruption* interruption, Interruption::Effect effect) : interruption_(interruption)
  {
    if (!interruption_) return;
    before_ = interruption_->effect();
    interruption_->set_effect(effect);
  }

  Effect_of_interruption(const Effect_of_interruption&) = delete;
  Effect_of_interruption& operator=(const Effect_of_interruption&) = delete;

  ~Effect_of_interruption()
  {
    if (interruption_) interruption_->set_effect(before_);
  }

private:
  Interruption* interruption_;
  Interruption::Effect before_ = Interruption::Effect::none;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_INTERRUPTION_H
