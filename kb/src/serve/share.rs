//! What one caller may take while others ask: places are given to one caller after the other, however many requests of one
//! of them wait, and what can be held for long is counted for each.

use std::collections::{BTreeMap, VecDeque};
use std::net::{IpAddr, Ipv6Addr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::oneshot;

/// Whose requests count together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Asker {
    /// Of the token of this name.
    Holder(String),
    /// Of who sends no token that is known.
    Address(IpAddr),
}

impl Asker {
    /// Whoever calls from there. In version 6 one customer has a whole network, of 64 bits.
    pub fn at(address: IpAddr) -> Self {
        Self::Address(match address.to_canonical() {
            IpAddr::V6(address) => Ipv6Addr::from_bits(address.to_bits() >> 64 << 64).into(),
            address @ IpAddr::V4(_) => address,
        })
    }

    /// Nobody in particular.
    pub fn unknown() -> Self {
        Self::Address(Ipv6Addr::UNSPECIFIED.into())
    }
}

/// Places at which something is worked on; who finds none waits, behind others' turns and not behind others' crowds.
pub struct Places {
    each: usize,
    lines: Mutex<Lines>,
}

struct Lines {
    free: usize,
    taken: BTreeMap<Arc<Asker>, usize>,
    /// Those who wait, by caller; whose turn is next stands first.
    waiting: VecDeque<(Arc<Asker>, VecDeque<oneshot::Sender<Place>>)>,
}

/// A line as long as this has places of requests that were given up: so many are not worked on.
const LONG_LINE: usize = 4_096;

impl Places {
    /// So many places, and so many of them for one caller at most.
    pub fn new(all: usize, each: usize) -> Arc<Self> {
        let lines = Lines { free: all, taken: BTreeMap::new(), waiting: VecDeque::new() };
        Arc::new(Self { each, lines: Mutex::new(lines) })
    }

    /// Waits for a place.
    pub async fn take(self: &Arc<Self>, asker: &Arc<Asker>) -> Place {
        let turn = {
            let mut lines = self.lines();
            let line = lines.waiting.iter().position(|(of, _)| of == asker);
            if line.is_none() && lines.free > 0 && lines.taken_by(asker) < self.each {
                lines.give(asker);
                return Place { places: Arc::clone(self), asker: Arc::clone(asker) };
            }
            let (sender, turn) = oneshot::channel();
            if let Some(line) = line {
                let line = &mut lines.waiting[line].1;
                if line.len() >= LONG_LINE {
                    line.retain(|waits| !waits.is_closed());
                }
                line.push_back(sender);
            } else {
                lines.waiting.push_back((Arc::clone(asker), VecDeque::from([sender])));
            }
            turn
        };
        turn.await.expect("who waits is taken out of the line by being given a place")
    }

    fn lines(&self) -> MutexGuard<'_, Lines> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives what is free to those who wait.
    fn pass_on(self: &Arc<Self>) {
        loop {
            let next = self.lines().next(self.each);
            let Some((asker, waits)) = next else { return };
            // whoever hung up meanwhile drops it, and it goes to the next: nothing is locked here
            drop(waits.send(Place { places: Arc::clone(self), asker }));
        }
    }
}

impl Lines {
    fn taken_by(&self, asker: &Asker) -> usize {
        self.taken.get(asker).copied().unwrap_or_default()
    }

    fn give(&mut self, asker: &Arc<Asker>) {
        self.free -= 1;
        *self.taken.entry(Arc::clone(asker)).or_default() += 1;
    }

    /// Whose turn it is, with a place given.
    fn next(&mut self, each: usize) -> Option<(Arc<Asker>, oneshot::Sender<Place>)> {
        for (_, line) in &mut self.waiting {
            while line.front().is_some_and(oneshot::Sender::is_closed) {
                line.pop_front();
            }
        }
        self.waiting.retain(|(_, line)| !line.is_empty());
        if self.free == 0 {
            return None;
        }
        let first = self.waiting.iter().position(|(asker, _)| self.taken_by(asker) < each)?;
        let (asker, mut line) = self.waiting.remove(first)?;
        let waits = line.pop_front()?;
        if !line.is_empty() {
            self.waiting.push_back((Arc::clone(&asker), line));
        }
        self.give(&asker);
        Some((asker, waits))
    }
}

/// A place, until it is dropped.
pub struct Place {
    places: Arc<Places>,
    asker: Arc<Asker>,
}

impl Drop for Place {
    fn drop(&mut self) {
        {
            let mut lines = self.places.lines();
            lines.free += 1;
            lines.taken.take_away(&self.asker, 1);
        }
        self.places.pass_on();
    }
}

trait Counts {
    /// Takes so much away; who has nothing is not counted.
    fn take_away(&mut self, asker: &Asker, amount: usize);
}

impl Counts for BTreeMap<Arc<Asker>, usize> {
    fn take_away(&mut self, asker: &Asker, amount: usize) {
        if let Some(has) = self.get_mut(asker) {
            *has = has.saturating_sub(amount);
            if *has == 0 {
                self.remove(asker);
            }
        }
    }
}

/// Of something that can be held for long: how much all hold, and how much each.
pub struct Stock {
    all: usize,
    each: usize,
    held: Mutex<(usize, BTreeMap<Arc<Asker>, usize>)>,
}

/// Why nothing more is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spent {
    /// The caller has its share.
    Share,
    /// All is taken.
    All,
}

impl Stock {
    /// So much for all, and so much of it for one caller at most.
    pub fn new(all: usize, each: usize) -> Arc<Self> {
        Arc::new(Self { all, each, held: Mutex::default() })
    }

    /// Holds so much. Who holds nothing gets what is there, if it is more than a share, too.
    pub fn hold(self: &Arc<Self>, asker: &Arc<Asker>, amount: usize) -> Result<Held, Spent> {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let has = held.1.get(asker).copied().unwrap_or_default();
        if held.0 > 0 && held.0 + amount > self.all {
            return Err(Spent::All);
        }
        if has > 0 && has + amount > self.each {
            return Err(Spent::Share);
        }
        held.0 += amount;
        *held.1.entry(Arc::clone(asker)).or_default() += amount;
        Ok(Held { stock: Arc::clone(self), asker: Arc::clone(asker), amount })
    }

    /// How much all hold.
    pub fn held(&self) -> usize {
        self.held.lock().unwrap_or_else(PoisonError::into_inner).0
    }
}

/// What is held, until it is dropped.
pub struct Held {
    stock: Arc<Stock>,
    asker: Arc<Asker>,
    amount: usize,
}

impl Drop for Held {
    fn drop(&mut self) {
        let mut held = self.stock.held.lock().unwrap_or_else(PoisonError::into_inner);
        held.0 -= self.amount;
        held.1.take_away(&self.asker, self.amount);
    }
}

/// A request's turn at the processor. It is left while the request waits for something else, so that it keeps nobody waiting.
pub struct Turn {
    pub asker: Arc<Asker>,
    places: Arc<Places>,
    place: Mutex<Option<Arc<Place>>>,
}

impl Turn {
    pub fn new(places: &Arc<Places>, asker: &Arc<Asker>) -> Self {
        Self { asker: Arc::clone(asker), places: Arc::clone(places), place: Mutex::default() }
    }

    pub async fn take(&self) {
        let place = self.places.take(&self.asker).await;
        *self.place.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(place));
    }

    /// The place, for work that goes on after its request has hung up.
    pub fn place(&self) -> Option<Arc<Place>> {
        self.place.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Does something else, and waits for the turn again.
    pub async fn aside<T>(&self, work: impl Future<Output = T>) -> T {
        self.place.lock().unwrap_or_else(PoisonError::into_inner).take();
        let done = work.await;
        self.take().await;
        done
    }
}

#[cfg(test)]
mod tests {
    use std::pin::Pin;
    use std::task::{Context, Poll, Wake, Waker};

    use super::*;

    fn asker(name: &str) -> Arc<Asker> {
        Arc::new(Asker::Holder(name.to_owned()))
    }

    fn now<T>(waits: &mut Pin<Box<impl Future<Output = T>>>) -> Option<T> {
        match waits.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(done) => Some(done),
            Poll::Pending => None,
        }
    }

    #[test]
    fn whoever_comes_last_does_not_wait_for_a_crowd() {
        let (places, crowd, other, third) =
            (Places::new(2, 1), asker("crowd"), asker("other"), asker("third"));
        let mut many: Vec<_> = (0..10).map(|_| Box::pin(places.take(&crowd))).collect();
        let mut held: Vec<Place> = many.iter_mut().filter_map(now).collect();
        assert_eq!(held.len(), 1, "one place is left for others");
        let mut first = Box::pin(places.take(&other));
        let got = now(&mut first).expect("it is free");
        let mut next = Box::pin(places.take(&third));
        assert!(now(&mut next).is_none());
        drop(got);
        assert!(now(&mut next).is_some(), "before the nine who came earlier");
        drop(next);
        drop(held.pop());
        let waiting = many.iter_mut().skip(1).filter_map(now).collect::<Vec<Place>>();
        assert_eq!(waiting.len(), 1);
    }

    #[test]
    fn who_hangs_up_is_passed_over() {
        let (places, one) = (Places::new(1, 1), asker("one"));
        let held = now(&mut Box::pin(places.take(&one))).expect("it is free");
        let mut gone = Box::pin(places.take(&one));
        let mut stays = Box::pin(places.take(&one));
        assert!(now(&mut gone).is_none() && now(&mut stays).is_none());
        drop(gone);
        drop(held);
        assert!(now(&mut stays).is_some());
        let lines = places.lines();
        assert_eq!((lines.free, lines.taken.len(), lines.waiting.len()), (1, 0, 0));
    }

    /// Whoever waits, and hangs up when told that it need not.
    struct HangsUp(Mutex<Option<Pin<Box<dyn Future<Output = Place> + Send>>>>);

    impl Wake for HangsUp {
        fn wake(self: Arc<Self>) {
            drop(self.0.lock().expect("nobody panicked").take());
        }
    }

    /// Once, whoever gave a place to somebody who hung up at that moment waited for itself, and everybody for it.
    #[test]
    fn who_hangs_up_while_a_place_is_given_holds_up_nobody() {
        let (places, one) = (Places::new(1, 1), asker("one"));
        let held = now(&mut Box::pin(places.take(&one))).expect("it is free");
        let (wanted, by) = (Arc::clone(&places), Arc::clone(&one));
        let mut waits: Pin<Box<dyn Future<Output = Place> + Send>> =
            Box::pin(async move { wanted.take(&by).await });
        let hangs_up = Arc::new(HangsUp(Mutex::default()));
        let waker = Waker::from(Arc::clone(&hangs_up));
        assert!(waits.as_mut().poll(&mut Context::from_waker(&waker)).is_pending());
        *hangs_up.0.lock().expect("nobody panicked") = Some(waits);
        let (say, heard) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            drop(held);
            say.send(()).ok();
        });
        heard.recv_timeout(std::time::Duration::from_secs(30)).expect("giving it back waits for nobody");
        assert!(now(&mut Box::pin(places.take(&one))).is_some());
    }

    #[test]
    fn a_share_is_spent_before_all_is() {
        let (stock, one, other) = (Stock::new(10, 6), asker("one"), asker("other"));
        let held = stock.hold(&one, 6).expect("it is there");
        assert_eq!(stock.hold(&one, 1).err(), Some(Spent::Share));
        let _five = stock.hold(&other, 4).expect("it is there");
        assert_eq!(stock.hold(&asker("third"), 1).err(), Some(Spent::All));
        drop(held);
        assert_eq!(stock.held(), 4);
        assert!(stock.hold(&one, 6).is_ok());
    }

    #[test]
    fn a_network_of_version_6_is_one_caller() {
        let at = |text: &str| Asker::at(text.parse().expect("an address"));
        assert_eq!(at("2001:db8::1"), at("2001:db8::2:1"));
        assert_ne!(at("2001:db8::1"), at("2001:db8:0:1::1"));
        assert_eq!(at("::ffff:10.0.0.1"), at("10.0.0.1"));
    }
}
