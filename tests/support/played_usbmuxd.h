#pragma once
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/support/zip_bytes.h"

namespace scantrove::test {

/// Bytes that a test gives out one after another. Any thread.
class PlayedBytes {
 public:
  void push(std::string bytes) {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(bytes));
    changed_.notify_all();
  }
  /// No more bytes follow.
  void end() {
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }
  /// Waits for the next bytes; none: the end.
  [[nodiscard]] std::optional<std::string> next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    std::string bytes = std::move(waiting_.front());
    waiting_.pop_front();
    return bytes;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> waiting_;
  bool is_over_ = false;
};

/// A stand-in for the service usbmuxd: it lists phones and plays bytes to who connects to one of them. Its
/// messages are property lists behind four little-endian numbers: size, version 1, kind 8, tag.
class PlayedUsbmuxd {
 public:
  /// What happens to a connection. `send` returns false once the other side is gone.
  using Send = std::function<bool(const std::string&)>;
  using Play = std::function<void(const Send& send)>;

  static constexpr int kDone = 0, kNoSuchPhone = 2, kNobodyListens = 3;

  /// `answer`: to a connection. After `play`, the connection is closed, or stays open and silent.
  explicit PlayedUsbmuxd(std::vector<std::string> udids, int answer = kDone, Play play = {},
                         bool stays_open = false)
      : udids_(std::move(udids)), answer_(answer), play_(std::move(play)), stays_open_(stays_open) {
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path().c_str(), sizeof address.sun_path - 1);
    if (bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        listen(listening_, 8) != 0)
      throw std::runtime_error("no socket for usbmuxd");
    thread_ = std::thread([this] { serveAll(); });
  }
  PlayedUsbmuxd(const PlayedUsbmuxd&) = delete;
  PlayedUsbmuxd& operator=(const PlayedUsbmuxd&) = delete;
  ~PlayedUsbmuxd() {
    is_over_ = true;
    thread_.join();
    for (std::thread& served : served_) served.join();
    close(listening_);
  }

  /// For USBMUXD_SOCKET_ADDRESS.
  [[nodiscard]] std::string address() const { return "UNIX:" + path(); }
  /// The port of the last connection, as the client meant it.
  [[nodiscard]] int port() const { return port_; }

 private:
  static constexpr int kPoll_ms = 20;

  [[nodiscard]] std::string path() const { return (folder_ / "usbmuxd").string(); }

  void serveAll() {
    while (!is_over_) {
      pollfd waiting{listening_, POLLIN, 0};
      if (::poll(&waiting, 1, kPoll_ms) <= 0) continue;
      const int client = accept(listening_, nullptr, nullptr);
      if (client >= 0) served_.emplace_back([this, client] { serve(client); });
    }
  }

  void serve(int client) {
    std::string head(16, '\0');
    while (readAll(client, head)) {
      std::string request(numberAt(head, 0) - head.size(), '\0');
      if (!readAll(client, request)) break;
      const std::string tag = head.substr(12, 4);
      if (request.find("ListDevices") != std::string::npos) {
        reply(client, tag, "<key>DeviceList</key><array>" + devices() + "</array>");
      } else if (request.find("Connect") != std::string::npos) {
        rememberPort(request);
        reply(client, tag,
              "<key>MessageType</key><string>Result</string><key>Number</key><integer>" +
                  std::to_string(answer_) + "</integer>");
        if (answer_ == kDone) play(client);
        break;
      }
    }
    close(client);
  }

  void play(int client) {
    if (play_) play_([&](const std::string& bytes) { return sendAll(client, bytes); });
    char ignored = 0;
    while (stays_open_ && !is_over_ && recv(client, &ignored, 1, MSG_DONTWAIT) != 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(kPoll_ms));
  }

  [[nodiscard]] std::string devices() const {
    std::string list;
    for (std::size_t i = 0; i < udids_.size(); ++i) {
      const std::string id = "<integer>" + std::to_string(i + 1) + "</integer>";
      list += "<dict><key>DeviceID</key>" + id + "<key>MessageType</key><string>Attached</string>" +
              "<key>Properties</key><dict><key>ConnectionType</key><string>USB</string><key>DeviceID</key>" +
              id + "<key>LocationID</key><integer>0</integer><key>ProductID</key><integer>4776</integer>" +
              "<key>SerialNumber</key><string>" + udids_[i] + "</string></dict></dict>";
    }
    return list;
  }

  void rememberPort(const std::string& request) {
    const std::size_t key = request.find("PortNumber");
    const std::size_t value = request.find("<integer>", key);
    if (value == std::string::npos) return;
    const int network_order = std::atoi(request.c_str() + value + std::strlen("<integer>"));
    port_ = (network_order & 0xff) << 8 | network_order >> 8;
  }

  static void reply(int client, const std::string& tag, const std::string& dictionary) {
    const std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<plist version=\"1.0\"><dict>" +
                             dictionary + "</dict></plist>";
    sendAll(client, littleEndianBytes(16 + text.size(), 4) + littleEndianBytes(1, 4) +
                        littleEndianBytes(8, 4) + tag + text);
  }

  static std::size_t numberAt(const std::string& bytes, std::size_t at) {
    std::size_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
  }

  static bool readAll(int client, std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count = recv(client, bytes.data() + at, bytes.size() - at, 0);
      if (count <= 0) return false;
      at += static_cast<std::size_t>(count);
    }
    return true;
  }
  static bool sendAll(int client, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count = ::send(client, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (count <= 0) return false;
      at += static_cast<std::size_t>(count);
    }
    return true;
  }

  TemporaryFolder folder_;
  std::vector<std::string> udids_;
  int answer_;
  Play play_;
  bool stays_open_;
  std::atomic<bool> is_over_ = false;
  std::atomic<int> port_ = 0;
  int listening_ = -1;
  std::vector<std::thread> served_;  // of thread_
  std::thread thread_;
};

}  // namespace scantrove::test
