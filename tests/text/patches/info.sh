printf '<patches source="room.wrl" method="path" samples="64" unit="in"><shape><triangle><patch v="0 0 0 100 0 0 0 100 0" rgb="1 2 3"/><patch side="back" v="0 0 0 100 0 0 0 100 0" rgb="0 0 0"/></triangle></shape></patches>' |
    gzip |
    wrlkit info -
