/** What the page knows. Whoever shows a part of it listens for its name. */

class Model extends EventTarget {
  /** `/api/site` */ site = null;
  /** `/api/floor`, unpacked */ map = null;
  /** `/api/weights`, as they fit it */ weights = null;
  /** `/api/tables` */ tables = null;
  /** What is asked: start, goal, robot. */ ask = { start: '', goal: '', robot: '' };
  /** `/api/route`, or `{error}` */ route = null;
  /** `/api/preview` of what is pending */ preview = null;
  /** `/api/preview` of what a form on the screen would make, or a question take back; `shapes` come and go with that */ ahead = null;
  /** What is edited and not saved, by a name of its own; see `pending.js`. */ pending = new Map();
  /** Why there is no preview of what is pending, as the service says it */ refusal = null;
  /** `/api/tunings` */ tunings = [];
  /** The tuning in which cells are edited; none: in the tables. */ editIn = '';
  /** Facts that are told, of `/api/facts` */ facts = [];
  /** What people laid over the map, of `/api/areas` */ laid = [];
  /** The answer to "why not that way?" */ whyNot = null;
  /** `/api/firm` of the present route */ firm = null;
  /** `/api/whereabouts`, each robot with a `key` */ robots = [];
  /** The key of the robot that is looked at */ lookedAt = null;
  /** What is seen now of the mission that is looked at again */ replay = null;
  /** The newest generation seen. */ generation = 0;
  /** Where rooms are in `map.rooms`, by their number. */ roomIndex = new Map();
  /** Where doors are in `map.doors`, by their number. */ doorIndex = new Map();

  /** What is drawn as it would be: what the form or the question that is open would do, else all that is pending. */
  get tried() {
    return this.ahead ?? this.preview;
  }

  /** Sets one part and tells who listens for it. */
  set(name, value) {
    this[name] = value;
    if (name === 'map') {
      this.roomIndex = new Map(value.rooms.map((room, index) => [room.room, index]));
      this.doorIndex = new Map(value.doors.map((door, index) => [door.door, index]));
    }
    this.dispatchEvent(new Event(name));
  }

  /** Calls `act` whenever one of these parts was set. */
  on(names, act) {
    for (const name of names.split(' ')) this.addEventListener(name, act);
  }

  /** Whether whoever looks at the page may do this. */
  may(role) {
    const roles = this.site?.roles ?? [];
    return roles.includes(role) || roles.includes('admin') || (role === 'tell' && roles.includes('tune'));
  }

  /** The table with this name. */
  table(name) {
    return this.tables?.tables.find((table) => table.table === name);
  }
}

export const model = new Model();
