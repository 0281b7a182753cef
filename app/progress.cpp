#include "progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <string_view>

#include "text.hpp"

namespace peritherm::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double plain_share = 0.1;
constexpr std::chrono::seconds plain_pause{10};
constexpr std::chrono::milliseconds live_pause{100};

double share_done(const Progress& progress) {
  return progress.end > 0.0 ? std::clamp(progress.time / progress.end, 0.0, 1.0) : 0.0;
}

int terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

/// Characters on the screen: bytes that begin one in UTF-8.
int width_of(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string figures(const Progress& progress) {
  const double share = share_done(progress);
  std::string text =
      fmt::format("{:3.0f} %  {} of {}  {}", 100.0 * share, quantity(progress.time, "s"), quantity(progress.end, "s"),
                  counted(static_cast<std::size_t>(std::max(progress.count.accepted, 0L)), "step", "steps"));
  if (progress.wall > 0.0) {
    text += fmt::format("  {:.4g} evaluations/s", static_cast<double>(progress.count.evaluations) / progress.wall);
    if (share > 0.0 && share < 1.0) {
      text += fmt::format("  {} left", duration_text(progress.wall * (1.0 - share) / share));
    }
  }
  return text;
}

}  // namespace

std::string progress_line(const Progress& progress, int width) {
  const std::string text = figures(progress);
  const int room = width - width_of(text) - 5;
  if (room >= 8) {
    const int length = std::min(room, 40);
    const int filled = static_cast<int>(share_done(progress) * length);
    return fmt::format("[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
                       std::string(static_cast<std::size_t>(length - filled), '-'), text);
  }
  std::string shortened = text;
  while (width_of(shortened) > std::max(width - 1, 0)) shortened.pop_back();
  return shortened;
}

ProgressDisplay::ProgressDisplay(std::ostream& out, Style style) : out_(out), style_(style), last_(Clock::now()) {}

void ProgressDisplay::show(const Progress& progress) {
  if (style_ == Style::live) show_live(progress);
  if (style_ == Style::plain) show_plain(progress);
}

void ProgressDisplay::show_live(const Progress& progress) {
  const auto now = Clock::now();
  if (line_open_ && now - last_ < live_pause) return;
  last_ = now;
  line_open_ = true;
  // "Erase to the end of the line" avoids the flicker of erasing first.
  out_ << '\r' << progress_line(progress, terminal_width()) << "\033[K" << std::flush;
}

void ProgressDisplay::show_plain(const Progress& progress) {
  const auto now = Clock::now();
  const double share = share_done(progress);
  if (share < last_share_ + plain_share && now - last_ < plain_pause) return;
  last_ = now;
  last_share_ = share;
  out_ << figures(progress) << std::endl;
}

void ProgressDisplay::close() {
  if (line_open_) out_ << "\r\033[K" << std::flush;
  line_open_ = false;
}

ProgressDisplay::Style display_style(bool quiet) {
  if (quiet) return ProgressDisplay::Style::silent;
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = isatty(STDOUT_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
  return can_redraw ? ProgressDisplay::Style::live : ProgressDisplay::Style::plain;
}

}  // namespace peritherm::app
