"""Fills a catalogue on a server with many objects of one view each."""
import random
import struct
import zlib


def png(size, bits, channels, value):
    """A picture with one value in all pixels."""
    kind = {1: 0, 3: 2}[channels]
    row = b"\0" + value.to_bytes(bits // 8, "big") * (channels * size)

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, bits, kind, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(row * size)) + chunk(b"IEND", b""))


def fill(server, database, count, seed):
    """The descriptors are random, so that no scan recognises one of these objects."""
    noise = random.Random(seed)
    server.sql(f"""
BEGIN;
SELECT setseed({noise.random()});
INSERT INTO sessions (id, source, started, ended) VALUES (1, 'filling', '2026-01-01T00:00:00Z', '2026-01-01T00:00:00Z');
INSERT INTO objects (id, number, name, size_x_m, size_y_m, size_z_m, first_session, created)
  SELECT g, g, 'Obj_' || g, 0.3, 0.2, 0.1, 1, '2026-01-01T00:00:00Z' FROM generate_series(1, {count}) g;
INSERT INTO views (id, object, first_object, session, frame_index, pose, direction_x, direction_y, direction_z, created,
                   color, mask, depth_mm)
  SELECT g, g, g, 1, g, '1 0 0 0 0 1 0 0 0 0 1 0', 0, 0, -1, '2026-01-01T00:00:00Z', decode('{png(8, 8, 3, 120).hex()}', 'hex'),
         decode('{png(8, 8, 1, 255).hex()}', 'hex'), decode('{png(8, 16, 1, 900).hex()}', 'hex')
  FROM generate_series(1, {count}) g;
INSERT INTO view_summaries (view, first_object, object_pixels, size_x_m, size_y_m, size_z_m)
  SELECT g, g, 64, 0.3, 0.2, 0.1 FROM generate_series(1, {count}) g;
INSERT INTO descriptors (view, mean_l, mean_a, mean_b, fine, colors)
  SELECT g, 100 * random(), 100 * random() - 50, 100 * random() - 50,
         (SELECT string_agg(decode(md5(g || ' ' || i), 'hex'), '') FROM generate_series(1, 192) i),
         (SELECT substr(string_agg(decode(md5(g || ',' || i), 'hex'), ''), 1, 605) FROM generate_series(1, 38) i)
  FROM generate_series(1, {count}) g;
UPDATE objects SET best_view = id;
INSERT INTO events (created, action, object, session, after_json)
  SELECT '2026-01-01T00:00:00Z', 'add', g, 1, '{{"name":"Obj_' || g || '"}}' FROM generate_series(1, {count}) g;
INSERT INTO events (created, action, object, session, after_json)
  SELECT '2026-01-01T00:00:00Z', 'add-view', g, 1, '{{"view":' || g || '}}' FROM generate_series(1, {count}) g;
SELECT setval(pg_get_serial_sequence('sessions', 'id'), 1);
SELECT setval(pg_get_serial_sequence('objects', 'id'), {count});
SELECT setval(pg_get_serial_sequence('views', 'id'), {count});
COMMIT;
ANALYZE;
""", database)
