#include "hal/servo/quicksilver_link.h"

#include <algorithm>

namespace lakshya {

using quicksilver::Command;
using quicksilver::CommandText;
using quicksilver::Reply;

namespace {

// What a busy drive is given before it is asked again.
constexpr Nanoseconds kBusyPause = 2 * kMillisecond;

// Of an adapter that gives back what it sends (RS-485 with two wires).
bool is_echo(std::string_view line, const CommandText& sent) {
  const auto text = sent.bytes().first(sent.bytes().size() - 1);
  return std::equal(line.begin(), line.end(), text.begin(), text.end(),
                    [](char heard, std::uint8_t said) { return static_cast<std::uint8_t>(heard) == said; });
}

}  // namespace

QuickSilverLink::QuickSilverLink(SerialPort& port, Clock& clock, std::array<int, 2> addresses, Times times,
                                 QuickSilverCounters& counters, Problem& problem)
    : port_(&port),
      clock_(&clock),
      addresses_(addresses),
      times_(times),
      counters_(&counters),
      problem_(&problem) {}

Status QuickSilverLink::open() {
  debts_ = {};
  const Status opened = port_->open();
  if (opened != Status::ok) problem_->set("drives: %s", port_->problem());
  return opened;
}

void QuickSilverLink::owe(std::size_t drive) {
  if (!owes_reply(drive)) debts_[drive] = {};
  ++debts_[drive].replies;
  debts_[drive].until = clock_->now() + times_.answer + times_.quiet;
}

Status QuickSilverLink::lost() {
  counters_->add(QuickSilverCounters::disconnections);
  problem_->set("drives: the serial port has gone: %s", port_->problem());
  return Status::disconnected;
}

template <class Judge>
Status QuickSilverLink::listen(Nanoseconds deadline, const Judge& judge) {
  bool damaged = false;
  // The clock is asked although read() has a deadline: a line that never falls silent keeps every read() short.
  do {
    std::array<std::uint8_t, 64> buffer;
    std::size_t count = 0;
    const Status got = port_->read(buffer, deadline, count);
    if (got == Status::disconnected) return lost();
    if (got != Status::ok) break;
    std::span<const std::uint8_t> rest(buffer.data(), count);
    while (collector_.take(rest)) {
      const Heard heard = judge(collector_.line());
      if (heard == Heard::answer) return Status::ok;
      damaged = damaged || heard == Heard::damage;
    }
  } while (clock_->now() < deadline);
  return damaged ? Status::bad_data : Status::timeout;
}

Status QuickSilverLink::settle_both(Nanoseconds deadline, Nanoseconds needed) {
  const Status first = settle(0, deadline, needed);
  return first != Status::ok ? first : settle(1, deadline, needed);
}

Status QuickSilverLink::settle(std::size_t drive, Nanoseconds deadline, Nanoseconds needed) {
  if (!port_->is_open()) return Status::disconnected;
  if (!owes_reply(drive)) return Status::ok;
  collector_.clear();
  Debt& debt = debts_[drive];
  const Status heard = listen(std::min(deadline, debt.until), [&](std::string_view line) {
    Reply reply;
    if (parse_reply(line, reply) == Status::ok && reply.address == addresses_[drive]) --debt.replies;
    return debt.replies == 0 ? Heard::answer : Heard::nothing;
  });
  if (heard == Status::disconnected) return heard;
  if (!owes_reply(drive)) {
    debt = {};
    if (clock_->now() + needed <= deadline) return Status::ok;
  }
  problem_->set("drive %d: no time left after the wait for a late reply", addresses_[drive]);
  return Status::timeout;
}

QuickSilverLink::Heard QuickSilverLink::judge(std::string_view line, std::size_t drive, const CommandText& sent,
                                              Reply& reply) {
  if (is_echo(line, sent)) return Heard::nothing;
  const auto expected = sent.command() == Command::read_register ? Reply::Kind::data : Reply::Kind::done;
  bool right = parse_reply(line, reply) == Status::ok;
  if (right && reply.address != addresses_[drive]) {
    counters_->add(QuickSilverCounters::wrong_address);
    return Heard::nothing;
  }
  right = right && (reply.kind == expected || reply.kind == Reply::Kind::nak);
  right = right && (reply.kind == Reply::Kind::done || reply.command == static_cast<int>(sent.command()));
  if (right) return Heard::answer;
  counters_->add(QuickSilverCounters::bad_replies);
  return Heard::damage;
}

Status QuickSilverLink::ask_once(std::size_t drive, const CommandText& text, Nanoseconds deadline, Reply& reply) {
  port_->discard_input();
  collector_.clear();
  owe(drive);
  deadline = std::min(deadline, clock_->now() + times_.answer);
  Status status = port_->write(text.bytes(), deadline);
  if (status == Status::disconnected) return lost();
  if (status == Status::ok) {
    status = listen(deadline, [&](std::string_view line) { return judge(line, drive, text, reply); });
  }
  if (status == Status::timeout) counters_->add(QuickSilverCounters::timeouts);
  if (status == Status::timeout || status == Status::bad_data) {
    problem_->set("drive %d: %s reply to command %d", addresses_[drive],
                  status == Status::timeout ? "no" : "no readable", static_cast<int>(text.command()));
  }
  if (status == Status::ok) debts_[drive] = {};
  return status;
}

Status QuickSilverLink::transact(std::size_t drive, const CommandText& text, Nanoseconds deadline, Reply& reply) {
  Status status = settle(drive, deadline, kCommandTime);
  if (status != Status::ok) return status;
  for (int attempt = 0; attempt < 2; ++attempt) {
    status = ask_once(drive, text, deadline, reply);
    if (status != Status::ok || reply.kind != Reply::Kind::nak) return status;
    counters_->add(QuickSilverCounters::naks);
    nak_code_ = reply.nak_code;
    problem_->set("drive %d: refused command %d: %s (%d)", addresses_[drive], static_cast<int>(text.command()),
                  quicksilver::nak_name(reply.nak_code), reply.nak_code);
    if (reply.nak_code != quicksilver::kNakBusy || clock_->now() + kBusyPause >= deadline) break;
    if (attempt == 0) clock_->sleep_until(clock_->now() + kBusyPause);
  }
  return Status::refused;
}

Status QuickSilverLink::command(std::size_t drive, const CommandText& text, Nanoseconds deadline) {
  Reply reply;
  return transact(drive, text, deadline, reply);
}

Status QuickSilverLink::read_register(std::size_t drive, int number, Nanoseconds deadline, std::int32_t& value) {
  Reply reply;
  Status status = transact(drive, {addresses_[drive], Command::read_register, {number}}, deadline, reply);
  if (status != Status::ok) return status;
  status = register_value(reply, value);
  if (status == Status::ok) return status;
  counters_->add(QuickSilverCounters::bad_replies);
  problem_->set("drive %d: register %d came as %zu words instead of two", addresses_[drive], number,
                reply.word_count);
  return status;
}

void QuickSilverLink::send_blindly(std::size_t drive, const CommandText& text, Nanoseconds deadline) {
  if (!port_->is_open()) return;
  owe(drive);
  if (port_->write(text.bytes(), deadline) == Status::disconnected) (void)lost();
}

}  // namespace lakshya
