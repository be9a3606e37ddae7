-- What a scan that stopped knew of its camera after its last frame: LZ4 of the words of CameraMemory. At most one row.
CREATE TABLE camera (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  frame INTEGER NOT NULL,
  packed BLOB NOT NULL,
  unpacked_bytes INTEGER NOT NULL,
  checksum INTEGER NOT NULL
);
