"""Opens SQLite files of Scantrove for reading."""

import sqlite3
from pathlib import Path
from urllib.parse import quote

from .errors import ScantroveError


def open_database(file, application_id, newest_version, called):
    """Opens the SQLite file read-only.

    application_id marks the kind of file; newest_version is the newest schema that this module reads. Raises
    ScantroveError if the file is missing, of another kind, damaged, or newer.
    """
    file = Path(file).absolute()
    if not file.is_file():
        raise ScantroveError(f"There is no {called} at {file}. Check the path.")
    try:
        connection, own_id, version = _read_header(file)
    except sqlite3.Error as error:
        raise ScantroveError(f"The {called} {file} cannot be read: {error}.") from error
    problem = None
    if own_id != application_id:
        problem = f"{file} is no {called} of Scantrove."
    elif version > newest_version:
        problem = (
            f"The {called} {file} was written by a newer Scantrove (its schema is version {version}, this module "
            f"reads versions up to {newest_version}). Update the module scantrove."
        )
    if problem:
        connection.close()
        raise ScantroveError(problem)
    connection.row_factory = sqlite3.Row
    return connection


def _read_header(file):
    """(connection, application id, version of the schema)."""
    address = "file:" + quote(str(file)) + "?mode=ro"
    # A file in WAL mode needs its index beside it. In a folder that cannot be written to, the file is read as it is,
    # which is right if no program has changes waiting in the -wal file.
    waiting = Path(str(file) + "-wal")
    options = [""] if waiting.exists() and waiting.stat().st_size > 0 else ["", "&immutable=1"]
    failure = None
    for option in options:
        connection = sqlite3.connect(address + option, uri=True)
        try:
            own_id = connection.execute("PRAGMA application_id").fetchone()[0]
            version = connection.execute("PRAGMA user_version").fetchone()[0]
            connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
            return connection, own_id, version
        except sqlite3.OperationalError as error:
            connection.close()
            failure = error
        except sqlite3.Error:
            connection.close()
            raise
    raise failure


def has_table(connection, name):
    """Whether the file has a table of that name; older files lack some."""
    query = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
    return connection.execute(query, (name,)).fetchone() is not None


def has_column(connection, table, column):
    """Whether the table has the column."""
    return any(row[1] == column for row in connection.execute(f"PRAGMA table_info({table})"))
