#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// An iPhone or iPad on USB, as the daemon usbmuxd reports it.
struct Phone {
  std::uint32_t handle = 0;  ///< of this connection
  std::string udid;
};

/// Phones on USB, in usbmuxd's order. usbmuxd that does not answer takes some seconds. Error: usbmuxd cannot
/// be reached; says what to do.
[[nodiscard]] Result<std::vector<Phone>> connectedPhones();

/// A connection to a port of a phone, which only receives. One thread.
class PhoneConnection {
 public:
  /// Error: nothing listens there, or the phone is gone; names it.
  [[nodiscard]] static Result<std::unique_ptr<PhoneConnection>> open(const Phone& phone, std::uint16_t port);
  /// Takes over a connected socket.
  explicit PhoneConnection(int socket) : socket_(socket) {}
  PhoneConnection(const PhoneConnection&) = delete;
  PhoneConnection& operator=(const PhoneConnection&) = delete;
  ~PhoneConnection();

  /// The bytes that arrived, at most 256 KiB; empty: timeout. Points into a buffer until the next call.
  /// Error: the phone ended the connection, or it is gone; the reason.
  [[nodiscard]] Result<std::string_view> receive(std::chrono::milliseconds timeout);

 private:
  int socket_;
  std::vector<char> buffer_;
};

}  // namespace scantrove
