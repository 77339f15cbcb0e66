// Two QuickSilver drives on one serial line: one command at a time, and its reply.
//
// A reply says who answers but, when it is a plain "done", not what. So that a late reply to a command that was given up is
// not taken for the next one's, a drive that owes a reply is asked nothing new until the reply has come, or `quiet` has
// passed since the time for the answer was over. A drive that answers later than that can be misunderstood.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/clock.h"
#include "hal/problem.h"
#include "hal/serial_port.h"
#include "hal/servo/quicksilver_protocol.h"

namespace lakshya {

struct QuickSilverCounters {
  enum Which : std::uint8_t {
    timeouts,          // commands that got no reply in time
    naks,              // replies that say no, "busy" included
    bad_replies,       // lines that are no reply, or none to this command
    wrong_address,     // replies of a drive that was not asked
    disconnections,    // how often the port went away
    refused_commands,  // velocities that drive() did not take
    position_jumps,    // positions that no wheel can have reached, and drives found to have started anew
    dead_programs,     // how often a resident program was found not to run, or not as it should
  };
  std::array<Counter, 8> all = {{{"timeouts"},
                                 {"naks"},
                                 {"bad_replies"},
                                 {"wrong_address"},
                                 {"disconnections"},
                                 {"refused_commands"},
                                 {"position_jumps"},
                                 {"dead_programs"}}};
  void add(Which which) { ++all[which].value; }
};

class QuickSilverLink {
 public:
  struct Times {
    Nanoseconds answer;  // is waited for at most, from the command on
    Nanoseconds quiet;   // after that
  };

  // Enough for any one command and its reply at 57600 baud.
  static constexpr Nanoseconds kCommandTime = 7 * kMillisecond;

  // All of them outlive the link. `addresses` are those of drive 0 and drive 1.
  QuickSilverLink(SerialPort& port, Clock& clock, std::array<int, 2> addresses, Times times,
                  QuickSilverCounters& counters, Problem& problem);

  bool is_open() const { return port_->is_open(); }
  Status open();
  void close() { port_->close(); }

  // A command that is answered by "done"; `text` is addressed to this drive. Asked once more when the drive is busy. timeout: no reply, or the drive owes one
  // and the deadline came first; bad_data: something came, but not the reply; refused: a nak; disconnected.
  Status command(std::size_t drive, const quicksilver::CommandText& text, Nanoseconds deadline);

  Status read_register(std::size_t drive, int number, Nanoseconds deadline, std::int32_t& value);

  // Waits for all replies that are owed; does nothing where none is. timeout: less than `needed` is left before the deadline then,
  // and what is begun could only end in the next debt.
  Status settle_both(Nanoseconds deadline, Nanoseconds needed);

  // Whether the last command that was refused was refused because the drive was busy.
  bool was_busy() const { return nak_code_ == quicksilver::kNakBusy; }

  // Writes and does not wait for the reply, whatever the drive owes.
  void send_blindly(std::size_t drive, const quicksilver::CommandText& text, Nanoseconds deadline);

  bool owes_reply(std::size_t drive) const {
    return debts_[drive].replies > 0 && debts_[drive].until > clock_->now();
  }

 private:
  enum class Heard : std::uint8_t { nothing, damage, answer };
  struct Debt {
    int replies = 0;
    Nanoseconds until = 0;
  };

  Status transact(std::size_t drive, const quicksilver::CommandText& text, Nanoseconds deadline,
                  quicksilver::Reply& reply);
  Status ask_once(std::size_t drive, const quicksilver::CommandText& text, Nanoseconds deadline,
                  quicksilver::Reply& reply);
  // Until `judge` says answer. ok, timeout, bad_data (damage was all there was) or disconnected.
  template <class Judge>
  Status listen(Nanoseconds deadline, const Judge& judge);
  Heard judge(std::string_view line, std::size_t drive, const quicksilver::CommandText& sent,
              quicksilver::Reply& reply);
  Status settle(std::size_t drive, Nanoseconds deadline, Nanoseconds needed);
  void owe(std::size_t drive);
  Status lost();

  SerialPort* port_;
  Clock* clock_;
  const std::array<int, 2> addresses_;
  const Times times_;
  QuickSilverCounters* counters_;
  Problem* problem_;
  std::array<Debt, 2> debts_{};
  int nak_code_ = 0;
  quicksilver::LineCollector collector_;
};

}  // namespace lakshya
