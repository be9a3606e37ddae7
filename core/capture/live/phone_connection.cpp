#include "core/capture/live/phone_connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <usbmuxd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace scantrove {

namespace {

constexpr std::size_t kReceivedAtOnce = std::size_t{256} << 10;

/// A text of fixed size, which may lack its end.
template <std::size_t Size>
std::string textOfArray(const char (&text)[Size]) {
  return {text, std::find(text, text + Size, '\0')};
}

}  // namespace

Result<std::vector<Phone>> connectedPhones() {
  usbmuxd_device_info_t* listed = nullptr;
  const int count = usbmuxd_get_device_list(&listed);
  if (count < 0)
    return fail(
        "The service usbmuxd, which connects iPhones on USB, does not answer.",
        "Install it: `sudo apt-get install usbmuxd`. It starts when the phone is plugged in; unlock the "
        "phone and trust this computer.");
  std::vector<Phone> phones;
  for (int i = 0; i < count; ++i) {
    if (listed[i].conn_type == CONNECTION_TYPE_USB)
      phones.push_back({listed[i].handle, textOfArray(listed[i].udid)});
  }
  usbmuxd_device_list_free(&listed);
  return phones;
}

Result<std::unique_ptr<PhoneConnection>> PhoneConnection::open(const Phone& phone, std::uint16_t port) {
  const int socket = usbmuxd_connect(phone.handle, port);
  if (socket >= 0) return std::make_unique<PhoneConnection>(socket);
  if (socket == -ENODEV) return fail("The iPhone " + phone.udid + " is gone.", "Plug it in again.");
  return fail(
      "The iPhone " + phone.udid + " does not stream.",
      "Open Record3D on it, choose USB streaming in its settings and press the record button; unlock the "
      "phone and trust this computer.");
}

PhoneConnection::~PhoneConnection() { usbmuxd_disconnect(socket_); }

Result<std::string_view> PhoneConnection::receive(std::chrono::milliseconds timeout) {
  pollfd waiting{socket_, POLLIN, 0};
  const int ready = poll(&waiting, 1, static_cast<int>(timeout.count()));
  if (ready < 0 && errno != EINTR) return fail(std::strerror(errno));
  if (ready <= 0) return std::string_view();
  buffer_.resize(kReceivedAtOnce);
  const ssize_t bytes = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (bytes == 0) return fail("the connection was ended");
  if (bytes > 0) return std::string_view(buffer_.data(), static_cast<std::size_t>(bytes));
  if (errno == EAGAIN || errno == EINTR) return std::string_view();
  return fail(std::strerror(errno));
}

}  // namespace scantrove
