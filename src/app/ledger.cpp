#include "app/ledger.h"

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace contactscope::app {

void Ledger::add(const std::string& stage, std::chrono::nanoseconds time, int count) {
  auto found = std::ranges::find(entries_, stage, &Entry::stage);
  if (found == entries_.end()) found = entries_.insert(entries_.end(), Entry{stage, {}, 0});
  found->time += time;
  found->count += count;
}

void Ledger::left_out(const std::string& what) {
  if (std::ranges::find(left_out_, what) == left_out_.end()) left_out_.push_back(what);
}

void Ledger::note(const std::string& text) {
  notes_.push_back(text);
}

void Ledger::print(std::ostream& out, const std::string& heading) const {
  out << heading << '\n';
  for (const std::string& text : notes_) out << "  " << text << '\n';
  for (const Entry& entry : entries_) {
    const double milliseconds = std::chrono::duration<double, std::milli>(entry.time).count();
    out << "  " << std::left << std::setw(24) << entry.stage << std::right << std::fixed
        << std::setprecision(2) << std::setw(10) << milliseconds << " ms";
    if (entry.count > 1) {
      out << std::setw(6) << entry.count << " times" << std::setprecision(3) << std::setw(10)
          << milliseconds / entry.count << " ms each";
    }
    out << '\n';
  }
  for (const std::string& what : left_out_) out << "  left out: " << what << '\n';
}

}  // namespace contactscope::app
